//! What can be done about true axes with a key.

use egui::Key;

use crate::annotate::{Confidence, Method, NUDGES_DEG, Pivot};
use crate::app::true_axes::{Draft, Turn};
use crate::app::{AnnotateCommand, Command, State};
use crate::ui::action::{ALT, Action, CTRL, Group, NONE, SHIFT};

fn action(title: impl Into<String>, command: AnnotateCommand) -> Action {
    Action::app(Group::TrueAxis, title, Command::Annotate(command))
}

/// Everything about true axes, as things are now. Most keys count in edit mode alone, before what they
/// mean otherwise.
pub(in crate::ui) fn actions(state: &State) -> Vec<Action> {
    let annotating = &state.annotating;
    let is_file = matches!(state.source(), Some(crate::app::Source::File(_)));
    let mut all = vec![
        Action::app(
            Group::Edit,
            "Set the true axis by hand",
            Command::Annotate(AnnotateCommand::Edit(!annotating.is_editing)),
        )
        .key(NONE, Key::T)
        .on(annotating.is_editing)
        .when(annotating.is_editing || state.shown().is_some()),
        action(
            "Blind: hide what is computed",
            AnnotateCommand::Blind(!annotating.is_blind),
        )
        .key(SHIFT, Key::B)
        .on(annotating.is_blind),
        action(
            "Show everybody's axes",
            AnnotateCommand::ShowAll(!annotating.shows_all),
        )
        .key(NONE, Key::W)
        .on(annotating.shows_all)
        .when(!annotating.is_blind),
        action("Next cloud without my axis", AnnotateCommand::NextWithout)
            .key(CTRL, Key::PageDown)
            .when(is_file && annotating.author().is_ok() && !annotating.mine.is_empty())
            .repeating(),
    ];
    all.extend(turning(state));
    all.extend(editing(state));
    all
}

/// In edit mode: undo, redo and escape.
pub(in crate::ui) fn history(state: &State) -> Option<[Action; 3]> {
    let annotating = &state.annotating;
    if !annotating.is_editing {
        return None;
    }
    let edit = |title: &str, command| Action::app(Group::Edit, title, Command::Annotate(command));
    let escape = if annotating.grabbed.is_some() || annotating.moving.is_some() {
        "Put the axis back"
    } else if annotating.draft == Draft::None {
        "Leave edit mode"
    } else {
        "Drop the half-set axis"
    };
    Some([
        edit("Undo the axis edit", AnnotateCommand::Undo)
            .key(CTRL, Key::Z)
            .when(annotating.can_edit() && annotating.reach.undo_steps() > 0)
            .repeating(),
        edit("Redo the axis edit", AnnotateCommand::Redo)
            .key(CTRL | SHIFT, Key::Z)
            .key(CTRL, Key::Y)
            .when(annotating.can_edit() && annotating.reach.redo_steps() > 0)
            .repeating(),
        edit(escape, AnnotateCommand::Escape).key(NONE, Key::Escape),
    ])
}

fn turning(state: &State) -> Vec<Action> {
    let annotating = &state.annotating;
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
                AnnotateCommand::Nudge(turn, sign * degrees),
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
    let annotating = &state.annotating;
    let can = annotating.can_edit();
    let has_axis = can && annotating.set_ends().is_some();
    let is_blind = annotating.is_blind;
    let hold = match annotating.pivot {
        Pivot::Middle => Pivot::PeduncleBase,
        Pivot::PeduncleBase => Pivot::BlossomEnd,
        Pivot::BlossomEnd => Pivot::Middle,
    };
    let confidence = |confidence| AnnotateCommand::Confidence(Some(confidence));
    let has_said = can && annotating.judgment().is_some();
    let all = [
        (
            action("Set both ends anew", AnnotateCommand::Anew).when(can),
            NONE,
            Key::S,
        ),
        (
            action("Exchange the ends", AnnotateCommand::Flip).when(has_axis),
            NONE,
            Key::X,
        ),
        (
            action(
                "Start from the peduncle's axis",
                AnnotateCommand::Start(Method::FromPeduncle),
            )
            .when(can && !is_blind),
            SHIFT,
            Key::P,
        ),
        (
            action(
                "Start from the computed axis",
                AnnotateCommand::Start(Method::FromComputed),
            )
            .when(can && !is_blind),
            SHIFT,
            Key::A,
        ),
        (
            action(
                "Check with a ghost of the cloud",
                AnnotateCommand::Ghost(annotating.ghost.next()),
            )
            .when(can),
            NONE,
            Key::G,
        ),
        (
            action(
                "Hold the middle, the base, the blossom end",
                AnnotateCommand::Hold(hold),
            )
            .when(can),
            NONE,
            Key::H,
        ),
        (
            action("The axis cannot be told", AnnotateCommand::CannotTell).when(can),
            NONE,
            Key::U,
        ),
        (
            action("Confidence low", confidence(Confidence::LOW)).when(has_said),
            CTRL,
            Key::Num1,
        ),
        (
            action("Confidence medium", confidence(Confidence::MEDIUM)).when(has_said),
            CTRL,
            Key::Num2,
        ),
        (
            action("Confidence high", confidence(Confidence::HIGH)).when(has_said),
            CTRL,
            Key::Num3,
        ),
        (
            action("Try to save again", AnnotateCommand::TryAgain).when(annotating.has_failed()),
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
