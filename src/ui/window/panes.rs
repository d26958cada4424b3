//! The contents of each pane.

use egui::{Frame, Margin, Panel, ScrollArea, WidgetText};
use egui_tiles::{Behavior, EditAction, SimplificationOptions, Tile, TileId, Tiles, UiResponse};

use crate::app::{Command, PeduncleCommand, State, TrueAxesCommand};
use crate::render::Viewport;
use crate::ui::action::{Act, Action, WindowAct};
use crate::ui::inspector::{plane_bar, view_bar, view3d};
use crate::ui::many::{self, PanelRequest};
use crate::ui::pane::Pane;
use crate::ui::panels::{
    clouds, contributions, estimators, hemisphere, parameters, ranking, score_map, simulate, why_this_score,
};
use crate::ui::widgets::notice;
use crate::ui::{peduncle, true_axes};

/// The state that the panes show, and the commands that they give.
pub struct Panes<'a> {
    pub state: &'a State,
    pub actions: &'a [Action],
    pub is_gpu: bool,
    pub acts: &'a mut Vec<Act>,
    pub commands: &'a mut Vec<Command>,
    /// The 3-D view's size; `None` while it is hidden.
    pub viewport: &'a mut Option<Viewport>,
    /// Whether the user has moved a pane.
    pub was_moved: &'a mut bool,
}

impl Behavior<Pane> for Panes<'_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _tile: TileId, pane: &mut Pane) -> UiResponse {
        if *pane == Pane::View {
            self.view(ui);
        } else {
            Frame::new()
                .inner_margin(Margin::same(8))
                .show(ui, |ui| self.panel(ui, *pane));
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        pane.title().into()
    }

    fn is_tab_closable(&self, tiles: &Tiles<Pane>, tile: TileId) -> bool {
        matches!(tiles.get(tile), Some(Tile::Pane(pane)) if pane.is_on_demand())
    }

    fn on_tab_close(&mut self, tiles: &mut Tiles<Pane>, tile: TileId) -> bool {
        // It stays in the arrangement, out of sight.
        tiles.set_visible(tile, false);
        false
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions {
            all_panes_must_have_tabs: true,
            ..SimplificationOptions::default()
        }
    }

    fn on_edit(&mut self, action: EditAction) {
        // A pane that gets hidden under the cursor cannot end its preview itself.
        if action == EditAction::TabSelected && self.state.previewed.is_some() {
            self.commands.push(Command::Preview(None));
        }
        if action == EditAction::TabSelected && self.state.peduncle.is_previewed {
            let preview = PeduncleCommand::Preview(false);
            self.commands.push(Command::Peduncle(preview));
        }
        *self.was_moved |= matches!(action, EditAction::TileResized | EditAction::TileDropped);
    }

    fn min_size(&self) -> f32 {
        120.0
    }

    fn gap_width(&self, _style: &egui::Style) -> f32 {
        4.0
    }
}

impl Panes<'_> {
    fn view(&mut self, ui: &mut egui::Ui) {
        Frame::new().inner_margin(Margin::symmetric(8, 4)).show(ui, |ui| {
            view_bar::show(ui, self.state, self.actions, self.acts);
            peduncle::bar(ui, self.state, self.actions, self.acts);
        });
        if !self.state.true_axes.is_blind {
            Panel::bottom("plane bar")
                .show_separator_line(false)
                .show(ui, |ui| {
                    plane_bar::show(ui, self.state, self.commands);
                });
        }
        true_axes::hint_bar(ui, self.state);
        let is_in_locked = true_axes::locked_views(ui, self.state, self.is_gpu, self.commands);
        let answer = view3d::show(ui, self.state, self.is_gpu, self.commands);
        *self.viewport = Some(answer.viewport);
        if self.state.true_axes.landing.is_some() && !is_in_locked && !answer.is_hovered {
            let gone = TrueAxesCommand::Hover(None);
            self.commands.push(Command::TrueAxes(gone));
        }
    }

    fn panel(&mut self, ui: &mut egui::Ui, pane: Pane) {
        let (state, commands) = (self.state, &mut *self.commands);
        let is_free = matches!(
            pane,
            Pane::View | Pane::Clouds | Pane::Parameters | Pane::TrueAxes
        );
        if state.true_axes.is_blind && !is_free {
            notice::hidden(ui);
            return;
        }
        match pane {
            Pane::View => {}
            Pane::Clouds => {
                let asked = clouds::show(ui, state, commands);
                self.acts.extend(asked.map(Act::Window));
            }
            Pane::Parameters => {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    parameters::show(ui, state, commands);
                });
            }
            Pane::ScoreMap => score_map::show(ui, state, commands),
            Pane::Hemisphere => hemisphere::show(ui, state, commands),
            Pane::Ranking => ranking::show(ui, state, commands),
            Pane::WhyThisScore => {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    why_this_score::show(ui, state, commands);
                });
            }
            Pane::Contributions => contributions::show(ui, state, commands),
            Pane::Table | Pane::Charts | Pane::Gallery | Pane::Sweep => {
                if state.has_unseen_results() {
                    commands.push(Command::TrueAxes(TrueAxesCommand::ResultsShown));
                }
                if let Some(answer) = many::show(ui, pane, state, commands) {
                    self.acts.push(Act::Window(match answer {
                        PanelRequest::ShowView => WindowAct::Show(Pane::View),
                        PanelRequest::SaveResults => WindowAct::SaveResults,
                        PanelRequest::CopyCommandLine => WindowAct::CopyEvaluation,
                    }));
                }
            }
            Pane::Simulate => {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    let asked = simulate::show(ui, state, commands);
                    self.acts.extend(asked.map(Act::Window));
                });
            }
            Pane::Estimators => {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    estimators::show(ui, state, commands);
                });
            }
            Pane::TrueAxes => {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    true_axes::show(ui, state, commands);
                });
            }
        }
    }
}
