//! True axes by hand: their panel, what the mouse does in edit mode, the locked views, and the keys.

mod agreement;
mod ask;
mod hints;
mod keys;
mod locked;
mod own;
mod panel;
mod stage;

pub(in crate::ui) use ask::{Farewell, ask_name};
pub(in crate::ui) use hints::show as hint_bar;
pub(in crate::ui) use keys::{actions, history};
pub(in crate::ui) use locked::show as locked_views;
pub use panel::show;
pub(in crate::ui) use stage::Stage;

use crate::app::{Command, TrueAxesCommand};
use crate::render::Color;

/// The axis that is being set: a hue apart from the computed axis and the reference.
const OWN: Color = [0xff, 0x5c, 0xd6, 255];

/// Hues of other people's axes.
const OTHERS: [Color; 6] = [
    [0xff, 0xb0, 0x00, 255],
    [0x48, 0xc9, 0xff, 255],
    [0xc6, 0xf0, 0x4a, 255],
    [0xff, 0x7a, 0x5c, 255],
    [0xb3, 0x9d, 0xff, 255],
    [0x5c, 0xf2, 0xc8, 255],
];

fn say(commands: &mut Vec<Command>, command: TrueAxesCommand) {
    commands.push(Command::TrueAxes(command));
}
