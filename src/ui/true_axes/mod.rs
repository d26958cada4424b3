//! True axes set by hand: the panel, editing in the views, the locked views, and the keyboard shortcuts.

mod annotators;
mod axis_view;
mod dialogs;
mod hints;
mod locked_views;
mod own_axis;
mod panel;
mod shortcuts;

pub(in crate::ui) use axis_view::AxisView;
pub(in crate::ui) use dialogs::{CloseDecision, ask_name};
pub(in crate::ui) use hints::show as hint_bar;
pub(in crate::ui) use locked_views::show as locked_views;
pub use panel::show;
pub(in crate::ui) use shortcuts::{actions, history};

use crate::app::{Command, TrueAxesCommand};
use crate::render::Color;

/// The color of the axis that is being set, distinct from those of the computed axis and the reference.
const OWN: Color = [0xff, 0x5c, 0xd6, 255];

/// The colors of the other annotators' axes.
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
