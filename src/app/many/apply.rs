//! The commands about the open clouds.

use super::Many;
use super::commands::ManyCommand;
use crate::app::command::Command;
use crate::app::context::Context;

impl Many {
    /// Does what is asked about the open clouds.
    pub(in crate::app) fn apply(&mut self, command: ManyCommand, cx: &mut Context) {
        match command {
            ManyCommand::Evaluate => {
                self.wants_all = true;
                self.look_up(cx);
            }
            ManyCommand::Cancel => {
                self.lane.cancel();
                self.expected.clear();
                self.wants_all = false;
                self.is_evaluating = false;
                cx.state.many.progress = None;
                cx.state.many.was_cancelled = true;
            }
            ManyCommand::Sort(sort) => {
                cx.state.many.sort = sort;
                cx.state.many.reorder();
            }
            ManyCommand::Filter(filter) => {
                cx.state.many.filter = *filter;
                cx.state.many.reorder();
            }
            ManyCommand::GoWorse(by) => go_worse(by, cx),
            ManyCommand::Picture(places) => self.want_pictures(&places, cx),
            ManyCommand::SweepRanges(ranges) => cx.state.many.sweep.ranges = *ranges,
            ManyCommand::Sweep => self.sweep(cx),
            ManyCommand::SaveResults(into) => self.save_results(into, cx),
            ManyCommand::CancelSweep => self.cancel_sweep(cx),
            ManyCommand::OpenSetting { u, tau_cm_per_rad } => {
                let mut request = cx.state.settings.request.clone();
                request.params.u = u;
                request.params.tau_cm_per_rad = tau_cm_per_rad;
                cx.set_request(request, None);
            }
            ManyCommand::Tag { place, tagged } => self.tag(place, tagged, cx),
        }
    }
}

/// Shows the cloud of the table whose error is the next larger or smaller.
fn go_worse(by: isize, cx: &mut Context) {
    let many = &cx.state.many;
    let error = |place: usize| many.rows[place].error_deg(many.against);
    let mut ranked: Vec<(f64, usize)> = many
        .order
        .iter()
        .filter_map(|&place| Some((error(place)?, place)))
        .collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(last) = ranked.len().checked_sub(1) else {
        cx.say(false, "No cloud has an error against this reference yet.");
        return;
    };
    let current = cx.state.current;
    let to = match ranked.iter().position(|&(_, place)| Some(place) == current) {
        Some(at) => at.checked_add_signed(by).map_or(0, |to| to.min(last)),
        None if by > 0 => last,
        None => 0,
    };
    let place = ranked[to].1;
    cx.ask(Command::Show(place));
}
