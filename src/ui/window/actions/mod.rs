//! Everything that can be done with a key, in one table: keys, menus, help sheet and command palette
//! are all made from it.

mod table;

use egui::{Key, KeyboardShortcut, Modifiers};

use super::layout::Pane;
use crate::app::{Command, State};
use crate::ui::true_axes;

/// Something that only the window can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowAct {
    /// Ask for files and open them.
    OpenFiles,
    /// Ask for a folder and open what is in it.
    OpenFolder,
    /// Ask how large a picture of the view is to be.
    SaveImage,
    /// Ask where it is to be saved, and save it with so many pixels.
    SaveImageOf([u32; 2]),
    /// Put the equivalent command line on the clipboard.
    CopyCommandLine,
    /// Ask where the results of all clouds are to be saved, and save them.
    SaveResults,
    /// Put the command line that evaluates all clouds on the clipboard.
    CopyEvaluation,
    /// Show the keys.
    Help,
    /// Look for a command by its name.
    Palette,
    /// Say what the program is.
    About,
    /// Bring a panel to the front.
    Show(Pane),
    /// Arrange the panels as at first.
    ResetLayout,
    /// End the program.
    Quit,
}

/// What an action does.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// The program does it.
    App(Command),
    /// The window does it.
    Window(WindowAct),
}

/// The part of the help sheet that an action stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Files and pictures.
    File,
    /// Undo and the parameters.
    Edit,
    /// The axis that is set by hand.
    TrueAxis,
    /// Which plane is looked at.
    Plane,
    /// Where the view is seen from.
    View,
    /// What the colors show.
    Color,
    /// What is drawn over the points.
    Overlay,
    /// Panels, help, looks.
    Window,
}

impl Group {
    /// All of them, in their order.
    pub const ALL: [Self; 8] = [
        Self::File,
        Self::Edit,
        Self::TrueAxis,
        Self::Plane,
        Self::View,
        Self::Color,
        Self::Overlay,
        Self::Window,
    ];

    /// Its title.
    pub fn title(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::TrueAxis => "True axis",
            Self::Plane => "Plane",
            Self::View => "View",
            Self::Color => "Color by",
            Self::Overlay => "Show",
            Self::Window => "Window",
        }
    }
}

/// Something that can be done.
#[derive(Debug, Clone)]
pub struct Action {
    /// Where the help sheet lists it.
    pub group: Group,
    /// What it does, in a few words.
    pub title: String,
    /// The keys that do it.
    pub keys: Vec<KeyboardShortcut>,
    /// What is to be done, as things are now.
    pub act: Act,
    /// Whether it can be done now.
    pub is_enabled: bool,
    /// Whether it is a switch that is on.
    pub is_on: Option<bool>,
    /// Whether holding the key does it again and again.
    pub repeats: bool,
}

impl Action {
    pub(in crate::ui) fn new(group: Group, title: impl Into<String>, act: Act) -> Self {
        Self {
            group,
            title: title.into(),
            keys: Vec::new(),
            act,
            is_enabled: true,
            is_on: None,
            repeats: false,
        }
    }

    pub(in crate::ui) fn app(group: Group, title: impl Into<String>, command: Command) -> Self {
        Self::new(group, title, Act::App(command))
    }

    pub(in crate::ui) fn window(title: impl Into<String>, group: Group, act: WindowAct) -> Self {
        Self::new(group, title, Act::Window(act))
    }

    pub(in crate::ui) fn key(mut self, modifiers: Modifiers, key: Key) -> Self {
        self.keys.push(KeyboardShortcut::new(modifiers, key));
        self
    }

    pub(in crate::ui) fn when(mut self, is_enabled: bool) -> Self {
        self.is_enabled = is_enabled;
        self
    }

    pub(in crate::ui) fn on(mut self, is_on: bool) -> Self {
        self.is_on = Some(is_on);
        self
    }

    pub(in crate::ui) fn repeating(mut self) -> Self {
        self.repeats = true;
        self
    }

    /// The keys in words.
    pub fn keys_text(&self, ctx: &egui::Context) -> String {
        let texts: Vec<String> = self.keys.iter().map(|k| key_text(ctx, k)).collect();
        texts.join(" or ")
    }
}

/// A key as it stands on the keyboard.
pub fn key_text(ctx: &egui::Context, key: &KeyboardShortcut) -> String {
    let text = ctx.format_shortcut(key);
    let name = key.logical_key.name();
    match key.logical_key {
        Key::OpenBracket => text.replace(name, "["),
        Key::CloseBracket => text.replace(name, "]"),
        Key::Questionmark => text.replace(name, "?"),
        Key::Period => text.replace(name, "."),
        Key::Plus => text.replace(name, "+"),
        Key::Equals => text.replace(name, "="),
        Key::Minus => text.replace(name, "-"),
        _ => text,
    }
}

pub use table::{coloring_title, overlay_title};
use table::{edit_actions, file_actions, plane_actions, style_actions, view_actions, window_actions};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const ALT: Modifiers = Modifiers::ALT;

/// Everything that can be done as things are now.
pub fn actions(state: &State) -> Vec<Action> {
    let mut all = file_actions(state);
    all.extend(edit_actions(state));
    all.extend(crate::ui::peduncle::keys::actions(state));
    all.extend(true_axes::actions(state));
    all.extend(plane_actions(state));
    all.extend(view_actions(state));
    all.extend(style_actions(state));
    all.extend(window_actions(state));
    all.extend(crate::ui::many::keys::actions(state));
    if state.true_axes.is_editing {
        give_way(&mut all);
    }
    if state.true_axes.is_blind {
        for action in &mut all {
            action.is_enabled &= !matches!(&action.act, Act::App(command) if command.reveals());
        }
    }
    all
}

/// In edit mode a key that turns or changes the axis means nothing else.
fn give_way(all: &mut [Action]) {
    let of_axis = |action: &&Action| action.group == Group::TrueAxis;
    let taken: Vec<KeyboardShortcut> = all.iter().filter(of_axis).flat_map(|a| a.keys.clone()).collect();
    for action in all.iter_mut().filter(|a| a.group != Group::TrueAxis) {
        action.keys.retain(|key| !taken.contains(key));
    }
}
