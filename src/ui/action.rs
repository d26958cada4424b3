//! An action: a command with its title, its keys, and its place in the menus.
//!
//! Each room of the interface lists its own actions; `window/actions` collects them.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::pane::Pane;
use crate::app::Command;

pub(in crate::ui) const NONE: Modifiers = Modifiers::NONE;
pub(in crate::ui) const CTRL: Modifiers = Modifiers::COMMAND;
pub(in crate::ui) const SHIFT: Modifiers = Modifiers::SHIFT;
pub(in crate::ui) const ALT: Modifiers = Modifiers::ALT;

/// A request that only the window can carry out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowAct {
    /// Ask for files and open them.
    OpenFiles,
    /// Ask for a folder and open the clouds in it.
    OpenFolder,
    /// Show the simulator and its pepper.
    Simulate,
    /// Ask for a path, and save the current cloud, which lies in no file.
    SaveCloud,
    /// Ask for the size of a picture of the view.
    SaveImage,
    /// Ask for the path of a picture of this size in pixels, and save it.
    SaveImageOf([u32; 2]),
    /// Put the equivalent command line on the clipboard.
    CopyCommandLine,
    /// Ask for a folder, and save the results of all clouds in it.
    SaveResults,
    /// Put the command line that evaluates all clouds on the clipboard.
    CopyEvaluation,
    /// Show the sheet of keys.
    Help,
    /// Open the command palette.
    Palette,
    /// Show the sheet about the program.
    About,
    /// Bring a pane to the front.
    Show(Pane),
    /// Arrange the panes as at first.
    ResetLayout,
    /// End the program.
    Quit,
}

/// The effect of an action.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// A command that the program carries out.
    App(Command),
    /// A request that the window carries out.
    Window(WindowAct),
}

/// The menu, and the part of the help sheet, that lists an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Files and pictures.
    File,
    /// Undo and the parameters.
    Edit,
    /// The axis that is set by hand.
    TrueAxis,
    /// The choice of the plane.
    Plane,
    /// The camera of the view.
    View,
    /// The coloring of the points.
    Color,
    /// The overlays on the points.
    Overlay,
    /// Panes, help, and the theme.
    Window,
}

impl Group {
    /// All groups, in the order of the menus.
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

    /// The title of the menu.
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

/// An entry of the menus, the help sheet and the command palette, with its keys.
#[derive(Debug, Clone)]
pub struct Action {
    /// The menu that lists it.
    pub group: Group,
    /// Its effect in a few words.
    pub title: String,
    /// Its keys.
    pub keys: Vec<KeyboardShortcut>,
    /// Its effect in the current state.
    pub act: Act,
    /// Whether it is available now.
    pub is_enabled: bool,
    /// The state of the switch, for an action that is one.
    pub is_on: Option<bool>,
    /// Whether a key that is held down repeats it.
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

    /// Returns the names of the keys, joined by “or”.
    pub fn keys_text(&self, ctx: &egui::Context) -> String {
        let texts: Vec<String> = self.keys.iter().map(|k| key_text(ctx, *k)).collect();
        texts.join(" or ")
    }
}

/// Returns the name of a key as printed on the keyboard.
pub fn key_text(ctx: &egui::Context, key: KeyboardShortcut) -> String {
    let text = ctx.format_shortcut(&key);
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
