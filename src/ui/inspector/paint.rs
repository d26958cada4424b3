//! The 3-D view within the window's drawing: it is drawn into targets of its own, a large cloud little by little, and
//! then composited into the window.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui_wgpu::{CallbackResources, CallbackTrait, ScreenDescriptor};
use egui::PaintCallbackInfo;

use crate::render::{Camera, Canvas, Extract, Line, Renderer, Scene};

/// One frame of a view.
pub(in crate::ui) struct ViewCallback {
    /// The identity of the view, which has targets of its own.
    pub(in crate::ui) view: egui::Id,
    pub(in crate::ui) scene: Arc<Scene>,
    /// Lines that come and go with the cursor.
    pub(in crate::ui) lines: Vec<Line>,
    pub(in crate::ui) camera: Camera,
    pub(in crate::ui) size_px: [u32; 2],
    pub(in crate::ui) is_software: bool,
    pub(in crate::ui) ctx: egui::Context,
}

/// All views with their shared renderer, kept among the window's own GPU resources.
pub struct Views {
    renderer: Renderer,
    views: HashMap<egui::Id, View>,
}

impl Views {
    /// Views for a window that is drawn in `format`.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        Self {
            renderer: Renderer::new(device, format),
            views: HashMap::new(),
        }
    }
}

#[derive(Default)]
struct View {
    canvas: Canvas,
    /// A canvas of half the pixels each way, for the software driver while the camera moves: most of its time goes into
    /// pixels.
    coarse: Canvas,
    shows_coarse: bool,
    camera: Option<Camera>,
    drawn: Option<Drawn>,
    pace: Pace,
    lines_generation: u64,
}

/// The content of a view's targets.
struct Drawn {
    scene: Arc<Scene>,
    lines: Vec<Line>,
    camera: Camera,
    size_px: [u32; 2],
    /// Points of each cloud that are in it.
    points: usize,
}

impl Drawn {
    fn is_of(&self, frame: &ViewCallback) -> bool {
        Arc::ptr_eq(&self.scene, &frame.scene)
            && self.camera == frame.camera
            && self.size_px == frame.size_px
            && self.lines == frame.lines
    }
}

/// The number of points of a frame, adapted to keep the frame rate.
struct Pace {
    points: usize,
    last: Option<Instant>,
}

impl Default for Pace {
    fn default() -> Self {
        Self {
            points: 50_000,
            last: None,
        }
    }
}

/// The time of a frame: 22 per second.
const FRAME: Duration = Duration::from_millis(45);

impl Pace {
    /// The points of the next frame, from how long the last one took that drew as many.
    fn next(&mut self, now: Instant, is_software: bool) -> usize {
        let (fewest, most) = if is_software {
            (8_000, 400_000)
        } else {
            (400_000, 8_000_000)
        };
        if let Some(last) = self.last {
            let took = now.duration_since(last);
            // After a longer pause the camera was not moving.
            if took < Duration::from_millis(700) {
                let ratio = FRAME.as_secs_f64() / took.as_secs_f64().max(1e-3);
                // Slowly upward, quickly downward.
                self.points = (self.points as f64 * ratio.clamp(0.3, 1.25)) as usize;
            }
        }
        self.last = Some(now);
        self.points = self.points.clamp(fewest, most);
        self.points
    }
}

impl CallbackTrait for ViewCallback {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        _screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let Some(Views { renderer, views }) = resources.get_mut::<Views>() else {
            return Vec::new();
        };
        let view = views.entry(self.view).or_default();
        let is_moving = view.camera.is_some_and(|last| last != self.camera);
        view.camera = Some(self.camera);
        if is_moving && self.is_software {
            self.draw_coarse(renderer, view, device, queue, encoder);
            self.ctx.request_repaint();
            return Vec::new();
        }
        view.shows_coarse = false;
        let total = self
            .scene
            .points
            .iter()
            .map(|p| p.positions.len())
            .max()
            .unwrap_or(0);
        let begun = view
            .drawn
            .as_ref()
            .filter(|drawn| drawn.is_of(self))
            .map(|d| d.points);
        if begun.is_some_and(|points| points >= total) {
            view.pace.last = None;
            return Vec::new();
        }
        let first = begun.unwrap_or(0);
        let count = view.pace.next(Instant::now(), self.is_software);
        // A small rest is not worth a frame of its own.
        let last = if first + count + count / 4 >= total {
            total
        } else {
            first + count
        };
        let extract = Extract {
            points: first..last.max(1),
            ..Extract::whole(self.size_px, if self.is_software { 1 } else { 2 })
        };
        let overlaid;
        let scene = if self.lines.is_empty() {
            &*self.scene
        } else {
            let mut scene = (*self.scene).clone();
            scene.lines.extend(&self.lines);
            // Apart from those of the scene itself, which count upward from zero.
            view.lines_generation += 1;
            scene.lines_generation = u64::MAX - view.lines_generation;
            overlaid = scene;
            &overlaid
        };
        view.canvas
            .draw(renderer, device, queue, encoder, scene, &self.camera, &extract);
        view.drawn = Some(Drawn {
            scene: self.scene.clone(),
            lines: self.lines.clone(),
            camera: self.camera,
            size_px: self.size_px,
            points: last,
        });
        if last < total {
            self.ctx.request_repaint();
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let views = resources.get::<Views>();
        if let Some((views, view)) = views.and_then(|v| Some((v, v.views.get(&self.view)?))) {
            let canvas = if view.shows_coarse {
                &view.coarse
            } else {
                &view.canvas
            };
            canvas.composite(&views.renderer, pass);
        }
    }
}

impl ViewCallback {
    /// A quick picture while the camera moves; the next frame without a movement is drawn in full.
    fn draw_coarse(
        &self,
        renderer: &Renderer,
        view: &mut View,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let mut scene = (*self.scene).clone();
        scene.lines.extend(&self.lines);
        scene.scale_lines(0.5);
        for points in &mut scene.points {
            points.size_px = (0.5 * points.size_px).max(1.0);
        }
        view.lines_generation += 1;
        scene.lines_generation = u64::MAX - view.lines_generation;
        let extract = Extract {
            points: 0..view.pace.next(Instant::now(), true).min(MOVING_POINTS),
            ..Extract::whole(self.size_px.map(|side| side.div_ceil(2)), 1)
        };
        view.coarse
            .draw(renderer, device, queue, encoder, &scene, &self.camera, &extract);
        view.shows_coarse = true;
        view.drawn = None;
    }
}

/// Points that are enough for a picture of half the pixels.
const MOVING_POINTS: usize = 60_000;
