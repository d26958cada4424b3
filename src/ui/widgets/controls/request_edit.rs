//! The change that the controls of one frame make to the request.

use egui::Response;

use crate::app::Command;
use crate::fruit::Request;

/// The request as the controls of one frame change it.
pub struct Edit<'a> {
    /// The request to be.
    pub request: Request,
    before: &'a Request,
    gesture: Option<&'static str>,
    ends: bool,
}

impl<'a> Edit<'a> {
    /// Begins with the request in force.
    pub fn of(before: &'a Request) -> Self {
        Self {
            request: before.clone(),
            before,
            gesture: None,
            ends: false,
        }
    }

    /// Notes the changes by a control that is dragged or stepped, which one undo takes back together.
    pub fn note(&mut self, response: &Response, control: &'static str) {
        if response.changed() {
            self.gesture = Some(control);
        }
        self.ends |= response.drag_stopped() || response.lost_focus();
    }

    /// Sends the changed request, and the end of a gesture.
    pub fn say(self, commands: &mut Vec<Command>) {
        if self.request != *self.before {
            commands.push(Command::Set {
                request: Box::new(self.request),
                gesture: self.gesture,
            });
        }
        if self.ends {
            commands.push(Command::EndGesture);
        }
    }
}
