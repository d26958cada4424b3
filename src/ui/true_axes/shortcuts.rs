//! The actions on true axes, with their keyboard shortcuts.

use egui::Key;

use crate::annotate::{Confidence, Method, NUDGES_DEG, Pivot};
use crate::app::true_axes::{Draft, Turn};
use crate::app::{Command, State, TrueAxesCommand};
use crate::ui::action::{ALT, Action, CTRL, Group, NONE, SHIFT};

fn action(title: impl Into<String>, command: TrueAxesCommand) -> Action {
    Action::app(Group::TrueAxis, title, Command::TrueAxes(command))
}

/// Returns all actions on true axes, enabled as the state allows. Most of their keys work in edit mode only, where they
/// take precedence over other meanings.
pub(in crate::ui) fn actions(state: &State) -> Vec<Action> {
    let annotating = &state.true_axes;
    let is_file = matches!(state.source(), Some(crate::app::Source::File(_)));
    let mut all = vec![
        Action::app(
            Group::Edit,
            "Set the true axis by hand",
            Command::TrueAxes(TrueAxesCommand::Edit(!annotating.is_editing)),
        )
        .key(NONE, Key::T)
        .on(annotating.is_editing)
        .when(annotating.is_editing || state.shown().is_some()),
        action(
            "Blind: hide what is computed",
            TrueAxesCommand::Blind(!annotating.is_blind),
        )
        .key(SHIFT, Key::B)
        .on(annotating.is_blind),
        action(
            "Show everybody's axes",
            TrueAxesCommand::ShowAll(!annotating.shows_all),
        )
        .key(NONE, Key::W)
        .on(annotating.shows_all)
        .when(!annotating.is_blind),
        action("Next cloud without my axis", TrueAxesCommand::NextWithout)
            .key(CTRL, Key::PageDown)
            .when(is_file && annotating.author().is_ok() && !annotating.mine.is_empty())
            .repeating(),
    ];
    all.extend(turning(state));
    all.extend(editing(state));
    all
}

/// Returns the actions of undo, redo and Escape in edit mode; `None` outside it.
pub(in crate::ui) fn history(state: &State) -> Option<[Action; 3]> {
    let annotating = &state.true_axes;
    if !annotating.is_editing {
        return None;
    }
    let edit = |title: &str, command| Action::app(Group::Edit, title, Command::TrueAxes(command));
    let escape = if annotating.grabbed.is_some() || annotating.moving.is_some() {
        "Put the axis back"
    } else if annotating.draft == Draft::None {
        "Leave edit mode"
    } else {
        "Drop the half-set axis"
    };
    Some([
        edit("Undo the axis edit", TrueAxesCommand::Undo)
            .key(CTRL, Key::Z)
            .when(annotating.can_edit() && annotating.history.undo_steps() > 0)
            .repeating(),
        edit("Redo the axis edit", TrueAxesCommand::Redo)
            .key(CTRL | SHIFT, Key::Z)
            .key(CTRL, Key::Y)
            .when(annotating.can_edit() && annotating.history.redo_steps() > 0)
            .repeating(),
        edit(escape, TrueAxesCommand::Escape).key(NONE, Key::Escape),
    ])
}

fn turning(state: &State) -> Vec<Action> {
    let annotating = &state.true_axes;
    let has_axis = annotating.can_edit() && annotating.set_ends().is_some();
    let ways = [
        ("Turn the axis clockwise", Turn::Picture, 1.0, Key::ArrowRight),
        (
            "Turn the axis counterclockwise",
            Turn::Picture,
            -1.0,
            Key::ArrowLeft,
        ),
        ("Lean the axis away", Turn::Lean, 1.0, Key::ArrowUp),
        ("Lean the axis towards you", Turn::Lean, -1.0, Key::ArrowDown),
    ];
    let mut all = Vec::new();
    for (title, turn, sign, key) in ways {
        for (degrees, modifiers) in NUDGES_DEG.into_iter().zip([ALT, NONE, SHIFT]) {
            let nudge = action(
                format!("{title} by {degrees}°"),
                TrueAxesCommand::Nudge(turn, sign * degrees),
            );
            let nudge = nudge.when(has_axis).repeating();
            all.push(if annotating.is_editing {
                nudge.key(modifiers, key)
            } else {
                nudge
            });
        }
    }
    all
}

fn editing(state: &State) -> Vec<Action> {
    let annotating = &state.true_axes;
    let can = annotating.can_edit();
    let has_axis = can && annotating.set_ends().is_some();
    let is_blind = annotating.is_blind;
    let hold = match annotating.pivot {
        Pivot::Middle => Pivot::PeduncleBase,
        Pivot::PeduncleBase => Pivot::BlossomEnd,
        Pivot::BlossomEnd => Pivot::Middle,
    };
    let confidence = |confidence| TrueAxesCommand::Confidence(Some(confidence));
    let has_said = can && annotating.judgment().is_some();
    let all = [
        (
            action("Set both ends anew", TrueAxesCommand::Anew).when(can),
            NONE,
            Key::S,
        ),
        (
            action("Exchange the ends", TrueAxesCommand::Flip).when(has_axis),
            NONE,
            Key::X,
        ),
        (
            action(
                "Start from the peduncle's axis",
                TrueAxesCommand::Start(Method::FromPeduncle),
            )
            .when(can && !is_blind),
            SHIFT,
            Key::P,
        ),
        (
            action(
                "Start from the computed axis",
                TrueAxesCommand::Start(Method::FromComputed),
            )
            .when(can && !is_blind),
            SHIFT,
            Key::A,
        ),
        (
            action(
                "Check with a ghost of the cloud",
                TrueAxesCommand::Ghost(annotating.ghost.next()),
            )
            .when(can),
            NONE,
            Key::G,
        ),
        (
            action(
                "Hold the middle, the base, the blossom end",
                TrueAxesCommand::Hold(hold),
            )
            .when(can),
            NONE,
            Key::H,
        ),
        (
            action("The axis cannot be told", TrueAxesCommand::CannotTell).when(can),
            NONE,
            Key::U,
        ),
        (
            action("Confidence low", confidence(Confidence::LOW)).when(has_said),
            NONE,
            Key::F2,
        ),
        (
            action("Confidence medium", confidence(Confidence::MEDIUM)).when(has_said),
            NONE,
            Key::F3,
        ),
        (
            action("Confidence high", confidence(Confidence::HIGH)).when(has_said),
            NONE,
            Key::F4,
        ),
        (
            action("Try to save again", TrueAxesCommand::TryAgain).when(annotating.has_failed()),
            NONE,
            Key::F6,
        ),
    ];
    all.into_iter()
        .map(|(action, modifiers, key)| {
            if annotating.is_editing {
                action.key(modifiers, key)
            } else {
                action
            }
        })
        .collect()
}
