//! Arrow keys that walk through what has the focus: rows of a table, planes of a drawing.

use egui::{Context, EventFilter, Id, Memory, Response, Ui};

fn walked() -> Id {
    Id::unique("what the arrow keys walk through")
}

/// Gives the arrow keys of that kind to a widget as long as it has the focus.
pub fn take_arrows(ui: &Ui, response: &Response, arrows: EventFilter) {
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    ui.data_mut(|data| data.insert_temp(walked(), response.id));
}

/// Returns whether the widget that has the focus walks by the arrow keys, so that they must do nothing else.
pub fn arrows_walk(ctx: &Context) -> bool {
    let focused = ctx.memory(Memory::focused);
    focused.is_some() && focused == ctx.data(|data| data.get_temp::<Id>(walked()))
}
