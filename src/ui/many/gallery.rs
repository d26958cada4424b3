//! Thumbnails of the clouds, the worst first. Only visible ones are drawn.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use egui::{
    Align2, Color32, ColorImage, Id, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind,
    TextStyle, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::{PanelRequest, bar};
use crate::app::many::{KEPT_PICTURES, ManyCommand};
use crate::app::{Command, State};
use crate::evaluate::THUMBNAIL_PX;
use crate::render::Image;
use crate::ui::widgets::controls::{small, warning_color};

/// The smallest width of a thumbnail in logical pixels.
const MIN_WIDTH: f32 = 170.0;
const GAP: f32 = 10.0;

/// The clouds in the order of the gallery, computed anew only after a change.
#[derive(Debug, Clone, Default)]
struct GalleryOrder {
    generation: u64,
    /// Places in the list by error, the largest first, then those without an error.
    order: Vec<usize>,
}

/// The state of the previous frame.
#[derive(Debug, Clone, Default, PartialEq)]
struct Seen {
    current: Option<usize>,
    in_sight: Vec<usize>,
    frame: u64,
    top: f32,
    height: f32,
}

/// Textures with the pictures that they were made of, by cloud.
type Textures = HashMap<PathBuf, (Arc<Image>, TextureHandle)>;

/// Draws the panel.
pub(in crate::ui) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) -> Option<PanelRequest> {
    let asked = bar::show(ui, state, commands);
    if asked.is_some() {
        return asked;
    }
    let gallery = gallery_order(ui, state);
    if gallery.order.is_empty() {
        bar::nothing_yet(ui, state);
        return None;
    }
    hint(ui, state);
    let id = Id::unique("gallery of clouds");
    let bar = ui.spacing().scroll.allocated_width() + 2.0;
    let width = ui.available_width() - bar;
    // There is at least one.
    let columns = ((width + GAP) / (MIN_WIDTH + GAP)).floor().max(1.0);
    let [w, h] = THUMBNAIL_PX;
    let picture_width = (width + GAP) / columns - GAP;
    let picture = vec2(picture_width, picture_width * h as f32 / w as f32);
    let text = ui.text_style_height(&TextStyle::Body);
    let card = vec2(picture_width, picture.y + 2.0 * text + 8.0);
    let columns = columns as usize;
    let rows = gallery.order.len().div_ceil(columns);
    ui.spacing_mut().item_spacing = vec2(GAP, GAP);

    let seen: Seen = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let frame = ui.ctx().cumulative_frame_nr();
    let mut area = ScrollArea::vertical().id_salt(id).auto_shrink([false, false]);
    if seen.current != state.current || frame > seen.frame + 1 {
        let place = state
            .current
            .and_then(|c| gallery.order.iter().position(|&p| p == c));
        let top = place.map(|place| (place / columns) as f32 * (card.y + GAP));
        let height = if seen.height > 0.0 {
            seen.height
        } else {
            ui.available_height()
        };
        let is_out = |top: &f32| *top < seen.top || *top + card.y > seen.top + height;
        if let Some(top) = top.filter(is_out) {
            area = area.vertical_scroll_offset((top - 0.3 * height).max(0.0));
        }
    }
    let mut in_sight = Vec::new();
    let mut chosen = None;
    let output = area.show_rows(ui, card.y, rows, |ui, range| {
        for row in range {
            ui.horizontal(|ui| {
                let places = gallery.order.iter().skip(row * columns).take(columns);
                for &place in places {
                    in_sight.push(place);
                    if self::card(ui, id, card, picture, state, place).clicked() {
                        chosen = Some(place);
                    }
                }
            });
        }
    });
    if in_sight != seen.in_sight || frame > seen.frame + 1 {
        commands.push(Command::Many(ManyCommand::Picture(in_sight.clone())));
    }
    let seen = Seen {
        current: state.current,
        in_sight,
        frame,
        top: output.state.clamped_offset().y,
        height: output.inner_rect.height(),
    };
    ui.data_mut(|data| data.insert_temp(id, seen));
    let place = chosen?;
    commands.push(Command::Show(place));
    Some(PanelRequest::ShowView)
}

fn hint(ui: &mut Ui, state: &State) {
    let filtered = if state.many.filter.is_empty() {
        String::new()
    } else {
        let (shown, all) = (state.many.order.len(), state.many.rows.len());
        format!(" {shown} of {all} clouds, as the table is filtered.")
    };
    let text = format!(
        "The largest error first; green is the computed axis. Shift+PageDown and Shift+PageUp go to the next larger \
         and smaller error.{filtered}"
    );
    ui.label(RichText::new(text).font(small(ui)));
}

fn gallery_order(ui: &Ui, state: &State) -> Arc<GalleryOrder> {
    let id = Id::unique("order of the gallery");
    let kept: Option<Arc<GalleryOrder>> = ui.data(|data| data.get_temp(id));
    let folder = &state.many;
    if let Some(kept) = kept.filter(|kept| kept.generation == folder.generation) {
        return kept;
    }
    let error = |place: usize| folder.rows[place].error_deg(folder.against);
    let mut order = folder.order.to_vec();
    order.sort_by(|&a, &b| match (error(a), error(b)) {
        (Some(a), Some(b)) => b.total_cmp(&a),
        (a, b) => b.is_some().cmp(&a.is_some()),
    });
    let made = Arc::new(GalleryOrder {
        generation: folder.generation,
        order,
    });
    ui.data_mut(|data| data.insert_temp(id, made.clone()));
    made
}

fn card(ui: &mut Ui, id: Id, size: Vec2, picture: Vec2, state: &State, place: usize) -> Response {
    let row = &state.many.rows[place];
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let response = ui.interact(rect, id.with(place), Sense::click());
    let is_current = state.current == Some(place);
    let error = row.error_deg(state.many.against);
    // The thumbnail may belong to the current parameters already, while the error does not.
    let before = if row.is_stale { " before" } else { "" };
    let off = error.map(|e| format!("{e:.1}°{before}"));
    response.widget_info(|| {
        let off = off.as_ref().map_or("no error".into(), |off| format!("{off} off"));
        let label = format!("Picture of {}, {off}", row.name);
        WidgetInfo::selected(Role::Button, true, is_current, label)
    });
    let frame = Rect::from_min_size(rect.min, picture);
    ui.painter()
        .rect_filled(frame, 3.0, ui.visuals().extreme_bg_color);
    let drawn = row
        .path
        .as_ref()
        .and_then(|path| Some((path, state.many.pictures.get(path)?)));
    match drawn.map(|(path, drawn)| (path, &drawn.image, drawn.is_stale)) {
        Some((path, Ok(image), is_stale)) => {
            let texture = texture(ui, path, image);
            let tint = if is_stale {
                Color32::from_gray(110)
            } else {
                Color32::WHITE
            };
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), frame, whole, tint);
        }
        Some((_, Err(why), _)) => words(ui, frame, why, warning_color(ui)),
        None if row.path.is_none() => words(ui, frame, "Samples have no picture.", ui.visuals().text_color()),
        None => words(ui, frame, "…", ui.visuals().text_color()),
    }
    let visuals = ui.visuals();
    let stroke = if is_current {
        Stroke::new(2.5, visuals.selection.bg_fill)
    } else if response.hovered() || response.has_focus() {
        visuals.widgets.hovered.fg_stroke
    } else {
        visuals.widgets.noninteractive.bg_stroke
    };
    ui.painter().rect_stroke(frame, 3.0, stroke, StrokeKind::Inside);

    let line = ui.text_style_height(&TextStyle::Body);
    let font = TextStyle::Body.resolve(ui.style());
    let first = frame.bottom() + 4.0;
    let color = ui.visuals().strong_text_color();
    let off = off.unwrap_or_else(|| "–".into());
    let at = pos2(frame.right(), first);
    let taken = ui.painter().text(at, Align2::RIGHT_TOP, off, font, color);
    let name = RichText::new(&row.name);
    let place = Rect::from_min_max(pos2(frame.left(), first), pos2(taken.left() - 6.0, first + line));
    one_line(ui, place, name);
    let below = pos2(frame.left(), first + line + 1.0);
    let place = Rect::from_min_max(below, pos2(frame.right(), below.y + line));
    let second = if row.tagged.tags.is_empty() {
        // The reason why a cloud is unusable is written in place of its thumbnail.
        let usable = row.outcome.as_ref().filter(|o| o.row().sha256.is_some());
        let failure = usable.and_then(|_| row.failure(state.many.against));
        failure.map(crate::text::sentence).unwrap_or_default()
    } else {
        row.tagged.tags.join(", ")
    };
    one_line(ui, place, RichText::new(second).font(small(ui)));
    if row.tagged.note.is_empty() {
        response
    } else {
        response.on_hover_text(&row.tagged.note)
    }
}

/// Writes a line of text, truncated to the width.
fn one_line(ui: &Ui, place: Rect, text: RichText) {
    let text = egui::WidgetText::from(text);
    let galley = text.into_galley(
        ui,
        Some(egui::TextWrapMode::Truncate),
        place.width(),
        TextStyle::Body,
    );
    ui.painter().galley(place.min, galley, ui.visuals().text_color());
}

fn words(ui: &Ui, frame: Rect, text: &str, color: Color32) {
    let galley = ui
        .painter()
        .layout(text.to_owned(), small(ui), color, frame.width() - 16.0);
    let place = frame.center() - 0.5 * galley.size();
    let painter = ui.painter().with_clip_rect(frame.intersect(ui.clip_rect()));
    painter.galley(place, galley, color);
}

/// Returns the texture of a thumbnail; their number is bounded.
fn texture(ui: &Ui, path: &PathBuf, image: &Arc<Image>) -> TextureHandle {
    let id = Id::unique("textures of the gallery");
    let textures: Arc<egui::mutex::Mutex<Textures>> = ui.data_mut(|data| {
        data.get_temp_mut_or_default::<Arc<egui::mutex::Mutex<Textures>>>(id)
            .clone()
    });
    let mut textures = textures.lock();
    if let Some((of, texture)) = textures.get(path)
        && Arc::ptr_eq(of, image)
    {
        return texture.clone();
    }
    if textures.len() >= KEPT_PICTURES {
        textures.clear();
    }
    // The sides are some hundred pixels long.
    let size = [image.width_px as usize, image.height_px as usize];
    let pixels = ColorImage::from_rgba_unmultiplied(size, &image.rgba);
    let name = path.display().to_string();
    let texture = ui.ctx().load_texture(name, pixels, TextureOptions::LINEAR);
    textures.insert(path.clone(), (image.clone(), texture.clone()));
    texture
}
