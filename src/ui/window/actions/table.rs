//! The actions on files, parameters, planes, view and window, with their keys.

use egui::Key;

use crate::app::true_axes::overlay_reveals;
use crate::app::{Command, PeduncleCommand, PlaneChoice, Sample, State, Tool};
use crate::method::Preset;
use crate::render::Projection;
use crate::ui::action::{ALT, Action, CTRL, Group, NONE, SHIFT, WindowAct};
use crate::ui::pane::Pane;
use crate::ui::true_axes;
use crate::view::{Coloring, Overlay, Style, Theme, ViewPreset};

pub(super) fn file_actions(state: &State) -> Vec<Action> {
    use Group::File;
    let current = state.current;
    let has_look = state.look.is_some();
    let mut actions = vec![
        Action::window("Open files …", File, WindowAct::OpenFiles).key(CTRL, Key::O),
        Action::window("Open a folder …", File, WindowAct::OpenFolder).key(CTRL | SHIFT, Key::O),
        Action::app(File, "Previous cloud", Command::Go(-1))
            .key(NONE, Key::PageUp)
            .when(state.neighbor(-1).is_some())
            .repeating(),
        Action::app(File, "Next cloud", Command::Go(1))
            .key(NONE, Key::PageDown)
            .when(state.neighbor(1).is_some())
            .repeating(),
        Action::app(File, "Read the file again", Command::Reload)
            .key(CTRL, Key::R)
            .when(current.is_some()),
        Action::app(File, "Close this cloud", Command::Close)
            .key(CTRL, Key::W)
            .when(current.is_some()),
        Action::window("Save the view as a picture …", File, WindowAct::SaveImage)
            .key(CTRL, Key::S)
            .when(has_look),
        Action::window(
            "Copy the equivalent command line",
            File,
            WindowAct::CopyCommandLine,
        )
        .key(CTRL | SHIFT, Key::C)
        .when(current.is_some()),
        Action::window("Quit", File, WindowAct::Quit).key(CTRL, Key::Q),
    ];
    let is_in_no_file = state.source().is_some_and(|source| !source.is_file());
    actions.extend([
        Action::window("Save the cloud as a file …", File, WindowAct::SaveCloud).when(is_in_no_file),
        Action::app(File, "Scan from here", Command::ScanFromHere).when(has_look),
        Action::window("Simulate a pepper …", File, WindowAct::Simulate),
    ]);
    actions.extend(Sample::ALL.map(|sample| {
        Action::app(
            File,
            format!("Open the sample: {}", sample.title()),
            Command::OpenSample(sample),
        )
    }));
    actions
}

pub(super) fn edit_actions(state: &State) -> Vec<Action> {
    use Group::Edit;
    let preset = state.settings.request.params.preset();
    let is_moving = state.tool == Tool::MoveCenter;
    let is_drawing = state.peduncle.strokes.back().is_some_and(|s| !s.is_ended);
    let escape = if state.peduncle.question.is_some() {
        let dismiss = Command::Peduncle(PeduncleCommand::Dismiss);
        Action::app(Edit, "Dismiss the question", dismiss)
    } else if is_drawing {
        let drop = Command::Peduncle(PeduncleCommand::DropStroke);
        Action::app(Edit, "Discard this stroke", drop)
    } else if state.progress.is_some() {
        Action::app(Edit, "Cancel the analysis", Command::Cancel)
    } else if is_moving {
        Action::app(Edit, "Stop moving the center", Command::Use(Tool::Navigate))
    } else if state.is_picking() {
        let navigate = Command::Use(Tool::Navigate);
        Action::app(Edit, "Stop picking the peduncle", navigate)
    } else if state.brush_cm.is_some() {
        Action::app(Edit, "Clear the brush", Command::Brush(None))
    } else {
        Action::app(Edit, "Clear the picked point", Command::Pick(None)).when(state.picked.is_some())
    };
    let history = true_axes::history(state).unwrap_or_else(|| {
        [
            Action::app(Edit, "Undo", Command::Undo)
                .key(CTRL, Key::Z)
                .when(state.can_undo)
                .repeating(),
            Action::app(Edit, "Redo", Command::Redo)
                .key(CTRL | SHIFT, Key::Z)
                .key(CTRL, Key::Y)
                .when(state.can_redo)
                .repeating(),
            escape.key(NONE, Key::Escape),
        ]
    });
    let mut actions = history.to_vec();
    actions.extend([
        Action::app(
            Edit,
            "Read the paper as intended",
            Command::UsePreset(Preset::AsIntended),
        )
        .key(NONE, Key::I)
        .on(preset == Some(Preset::AsIntended)),
        Action::app(
            Edit,
            "Read the paper as printed",
            Command::UsePreset(Preset::AsPrinted),
        )
        .key(SHIFT, Key::I)
        .on(preset == Some(Preset::AsPrinted)),
        Action::app(
            Edit,
            "Move the fruit center in the view",
            Command::Use(if is_moving {
                Tool::Navigate
            } else {
                Tool::MoveCenter
            }),
        )
        .key(NONE, Key::C)
        .on(is_moving)
        .when(state.analysis().is_some()),
        Action::app(Edit, "Analyze now", Command::Resume)
            .key(NONE, Key::F5)
            .when(state.was_cancelled),
    ]);
    actions
}

pub(super) fn plane_actions(state: &State) -> Vec<Action> {
    use Group::Plane;
    let u = state.analysis().map(|a| a.planes.grid.u().cast_signed());
    let has = u.is_some();
    let row = u.unwrap_or(1);
    let step = |title: &str, command| Action::app(Plane, title, command).when(has).repeating();
    vec![
        Action::app(Plane, "Best plane", Command::LookAt(PlaneChoice::Best))
            .key(NONE, Key::Home)
            .when(has),
        step("Previous plane", Command::Step(-1)).key(NONE, Key::ArrowLeft),
        step("Next plane", Command::Step(1)).key(NONE, Key::ArrowRight),
        step("Previous step of α", Command::Step(-row)).key(SHIFT, Key::ArrowLeft),
        step("Next step of α", Command::Step(row)).key(SHIFT, Key::ArrowRight),
        step("Better plane", Command::StepRank(-1)).key(NONE, Key::ArrowUp),
        step("Worse plane", Command::StepRank(1)).key(NONE, Key::ArrowDown),
        Action::app(
            Plane,
            if state.is_playing {
                "Stop playing"
            } else {
                "Play through all planes"
            },
            Command::Play(!state.is_playing),
        )
        .key(NONE, Key::Space)
        .on(state.is_playing)
        .when(has),
    ]
}

pub(super) fn view_actions(state: &State) -> Vec<Action> {
    use Group::View;
    let has = state.look.is_some();
    let view = |title: &str, preset, key| {
        Action::app(View, title, Command::View(preset))
            .key(ALT, key)
            .when(has)
    };
    let is_orthographic = state.camera.projection == Projection::Orthographic;
    let other = if is_orthographic {
        Projection::Perspective
    } else {
        Projection::Orthographic
    };
    vec![
        Action::app(View, "Fit everything into the view", Command::Frame)
            .key(NONE, Key::F)
            .when(has),
        view("From the camera", ViewPreset::Camera, Key::Num1),
        view("Front", ViewPreset::Front, Key::Num2),
        view("Side", ViewPreset::Side, Key::Num3),
        view("Top", ViewPreset::Top, Key::Num4),
        view("Along the plane's normal", ViewPreset::Normal, Key::Num5),
        view("Along the axis", ViewPreset::Axis, Key::Num6),
        Action::app(View, "Without perspective", Command::Project(other))
            .key(NONE, Key::O)
            .on(is_orthographic)
            .when(has),
        Action::app(View, "Turn about the picked point", Command::PivotOnPicked)
            .key(NONE, Key::Period)
            .when(has),
    ]
}

/// Returns the command that changes the style of the view.
fn restyle(state: &State, change: impl FnOnce(&mut Style)) -> Command {
    let mut style = state.style.clone();
    change(&mut style);
    Command::Style(Box::new(style))
}

pub(super) fn style_actions(state: &State) -> Vec<Action> {
    let (style, is_blind) = (&state.style, state.true_axes.is_blind);
    let mut actions = Vec::new();
    for coloring in Coloring::ALL {
        let (title, key) = coloring_title(coloring);
        let command = restyle(state, |style| style.coloring = coloring);
        actions.push(
            Action::app(Group::Color, title, command)
                .key(NONE, key)
                .on(state.shown_style().coloring == coloring)
                .when(!(is_blind && coloring.needs_plane())),
        );
    }
    for overlay in Overlay::ALL {
        let is_on = style.overlays.has(overlay);
        let (title, key) = overlay_title(overlay);
        let is_hidden = is_blind && overlay_reveals(overlay);
        let command = restyle(state, |style| style.overlays.set(overlay, !is_on));
        let action = Action::app(Group::Overlay, title, command)
            .on(is_on && !is_hidden)
            .when(!is_hidden);
        actions.push(match key {
            Some(key) => action.key(NONE, key),
            None => action,
        });
    }
    let shading = restyle(state, |style| style.eye_dome = !style.eye_dome);
    actions.push(
        Action::app(Group::Overlay, "Shading by depth", shading)
            .key(NONE, Key::E)
            .on(style.eye_dome),
    );
    let size = style.point_size.unwrap_or(4.0);
    for (title, key, factor) in [
        ("Larger points", Key::CloseBracket, 1.25),
        ("Smaller points", Key::OpenBracket, 1.0 / 1.25),
    ] {
        let size = (factor * size).clamp(1.0, 24.0);
        let command = restyle(state, |style| style.point_size = Some(size));
        let action = Action::app(Group::Overlay, title, command).repeating();
        // While the brush is in hand, these keys size it.
        let is_brush = state.tool == Tool::Brush;
        actions.push(if is_brush { action } else { action.key(NONE, key) });
    }
    actions
}

/// Returns a coloring's name in menus, and its key.
fn coloring_title(coloring: Coloring) -> (&'static str, Key) {
    match coloring {
        Coloring::Rgb => ("Colors of the file", Key::Num1),
        Coloring::Side => ("Side of the plane", Key::Num2),
        Coloring::Partner => ("Visible symmetric partner", Key::Num3),
        Coloring::Distance => ("Distance d", Key::Num4),
        Coloring::Angle => ("Angle ξ", Key::Num5),
        Coloring::Score => ("Contribution d + τξ", Key::Num6),
        Coloring::Normal => ("Direction of the normal", Key::Num7),
        Coloring::Label => ("Label", Key::Num8),
    }
}

/// Returns an overlay's name in menus, and its key.
fn overlay_title(overlay: Overlay) -> (&'static str, Option<Key>) {
    match overlay {
        Overlay::Plane => ("Candidate plane", Some(Key::P)),
        Overlay::Normal => ("Plane's normal", Some(Key::N)),
        Overlay::Center => ("Fruit center", None),
        Overlay::Viewpoint => ("Viewpoint and its ray", Some(Key::V)),
        Overlay::Axis => ("Computed axis", Some(Key::A)),
        Overlay::Reference => ("Reference axis", Some(Key::R)),
        Overlay::References => ("All reference axes", None),
        Overlay::Ghost => ("Mirrored cloud", Some(Key::G)),
        Overlay::Partners => ("Lines to partners", Some(Key::L)),
        Overlay::Normals => ("Normals of points", Some(Key::M)),
        Overlay::Legend => ("Legend", None),
        Overlay::Scale => ("Scale bar", None),
        Overlay::Triad => ("Directions x, y, z", None),
        Overlay::Caption => ("Caption", None),
    }
}

pub(super) fn window_actions(state: &State) -> Vec<Action> {
    use Group::Window;
    let theme = if state.is_dark() {
        Theme::Light
    } else {
        Theme::Dark
    };
    let scale = state.interface_scale;
    let mut actions = vec![
        Action::window("Keys and help", Window, WindowAct::Help)
            .key(NONE, Key::F1)
            .key(NONE, Key::Questionmark),
        Action::window("Find a command …", Window, WindowAct::Palette)
            .key(CTRL, Key::P)
            .key(CTRL, Key::K),
        Action::app(
            Window,
            "Light colors",
            restyle(state, |style| style.theme = theme),
        )
        .key(SHIFT, Key::T)
        .on(!state.is_dark()),
        Action::app(Window, "Larger interface", Command::Scale(scale + 0.1))
            .key(CTRL, Key::Plus)
            .key(CTRL, Key::Equals),
        Action::app(Window, "Smaller interface", Command::Scale(scale - 0.1)).key(CTRL, Key::Minus),
        Action::app(Window, "Interface at normal size", Command::Scale(1.0)).key(CTRL, Key::Num0),
        Action::window("Reset the layout of the panels", Window, WindowAct::ResetLayout),
        Action::window("About Axiscope", Window, WindowAct::About),
    ];
    actions.extend(
        Pane::ALL
            .into_iter()
            // The panes with a key are listed with it, among the actions on all clouds.
            .filter(|pane| !pane.has_key())
            .map(|pane| Action::window(format!("Panel: {}", pane.title()), Window, WindowAct::Show(pane))),
    );
    actions
}
