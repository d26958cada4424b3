//! One view's picture on the GPU: its targets, its buffers, and the passes that draw it.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::DMat4;
use wgpu::BindingResource;

use super::pipelines::{COLOR, DEPTH};
use super::uploads::{GrowingBuffer, LineInstance, PointsUpload, triangles};
use super::{Camera, Color, Projection, Renderer, Scene, Viewport};

/// The view as every shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct ViewUniform {
    clip_from_local: [f32; 16],
    size_px: [f32; 2],
    near: f32,
    far: f32,
    background_top: [f32; 4],
    background_bottom: [f32; 4],
    eye_dome_strength: f32,
    eye_dome_scale: f32,
    is_orthographic: f32,
    oversampling: f32,
}

/// The part of a scene that is drawn, and its size in pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extract {
    /// Width and height of the picture.
    pub size_px: [u32; 2],
    /// Each pixel is the mean of this many squared (1 or 2).
    pub oversampling: u32,
    /// The range of points of each cloud. Points are ordered so that every prefix is spread evenly over the cloud:
    /// `0..20_000` is a thinned cloud. A range that begins later adds to the last picture of the same camera, so that a
    /// large cloud can appear little by little.
    pub points: Range<usize>,
}

impl Extract {
    /// The whole scene.
    pub fn whole(size_px: [u32; 2], oversampling: u32) -> Self {
        Self {
            size_px,
            oversampling,
            points: 0..usize::MAX,
        }
    }
}

/// The render targets of one size.
struct Targets {
    size_px: [u32; 2],
    points_color: wgpu::TextureView,
    depth: wgpu::TextureView,
    /// The points' depth, into which the lines are drawn as well.
    overlaid_depth: wgpu::TextureView,
    picture: wgpu::TextureView,
    shading_group: wgpu::BindGroup,
    composite_group: wgpu::BindGroup,
}

/// The render targets and buffers of one view. Each view has its own, so that none overwrites another's.
#[derive(Default)]
pub struct Canvas {
    targets: Option<Targets>,
    view: Option<(wgpu::Buffer, wgpu::BindGroup)>,
    points: Vec<PointsUpload>,
    lines: GrowingBuffer,
    lines_state: Option<(u64, usize, [u64; 3])>,
    planes: GrowingBuffer,
}

impl Canvas {
    /// A canvas on which nothing was drawn yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Records the drawing of the scene into the canvas. The caller submits the encoder.
    #[expect(
        clippy::too_many_arguments,
        reason = "what a window's paint callback hands over, and what to draw"
    )]
    pub fn draw(
        &mut self,
        renderer: &Renderer,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        camera: &Camera,
        extract: &Extract,
    ) {
        let largest = device.limits().max_texture_dimension_2d;
        let oversampling = extract.oversampling.clamp(1, 2);
        let drawn_px = extract
            .size_px
            .map(|side| (side.max(1) * oversampling).min(largest));
        self.upload(renderer, device, queue, scene, camera, extract.points.end);
        self.upload_view(renderer, device, queue, scene, camera, drawn_px, oversampling);
        let is_fresh = extract.points.start == 0;
        if self.targets.as_ref().is_none_or(|t| t.size_px != drawn_px) {
            self.targets = Some(Targets::new(renderer, device, drawn_px));
        }
        let (Some(targets), Some((_, view))) = (&self.targets, &self.view) else {
            return;
        };
        {
            let mut pass = begin(
                encoder,
                "points",
                &targets.points_color,
                Some((&targets.depth, is_fresh)),
            );
            pass.set_bind_group(0, view, &[]);
            self.draw_points(renderer, &mut pass, &extract.points);
        }
        encoder.copy_texture_to_texture(
            targets.depth.texture().as_image_copy(),
            targets.overlaid_depth.texture().as_image_copy(),
            targets.depth.texture().size(),
        );
        {
            let mut pass = begin(encoder, "shading", &targets.picture, None);
            pass.set_bind_group(0, view, &[]);
            pass.set_bind_group(1, &targets.shading_group, &[]);
            pass.set_pipeline(&renderer.shading);
            pass.draw(0..3, 0..1);
        }
        let mut pass = begin(
            encoder,
            "overlays",
            &targets.picture,
            Some((&targets.overlaid_depth, false)),
        );
        pass.set_bind_group(0, view, &[]);
        // First the hidden parts of lines, faintly; then lines, which hide the planes behind them; then planes.
        if let (Some(buffer), 1..) = (self.lines.get(), scene.lines.len() as u32) {
            pass.set_vertex_buffer(0, buffer.slice(..));
            for pipeline in [&renderer.hidden_lines, &renderer.seen_lines] {
                pass.set_pipeline(pipeline);
                pass.draw(0..4, 0..scene.lines.len() as u32);
            }
        }
        let corners: usize = scene
            .polygons
            .iter()
            .map(|p| 3 * p.corners_in_world.len().saturating_sub(2))
            .sum();
        if let (Some(buffer), 1..) = (self.planes.get(), corners as u32) {
            pass.set_pipeline(&renderer.planes);
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(0..corners as u32, 0..1);
        }
    }

    /// Draws the last picture into the caller's pass, filling its viewport.
    pub fn composite(&self, renderer: &Renderer, pass: &mut wgpu::RenderPass<'_>) {
        if let (Some(targets), Some((_, view))) = (&self.targets, &self.view) {
            pass.set_pipeline(&renderer.composite);
            pass.set_bind_group(0, view, &[]);
            pass.set_bind_group(1, &targets.composite_group, &[]);
            pass.draw(0..3, 0..1);
        }
    }

    fn draw_points(&self, renderer: &Renderer, pass: &mut wgpu::RenderPass<'_>, points: &Range<usize>) {
        pass.set_pipeline(&renderer.points);
        for cloud in &self.points {
            pass.set_bind_group(1, &cloud.look_group, &[]);
            let mut begin = 0;
            for chunk in &cloud.chunks {
                let within = |place: usize| place.clamp(begin, begin + chunk.count) - begin;
                let (first, last) = (within(points.start), within(points.end));
                begin += chunk.count;
                if let (Some(positions), Some(colors)) = (chunk.positions.get(), chunk.colors.get())
                    && first < last
                {
                    pass.set_vertex_buffer(0, positions.slice(..));
                    pass.set_vertex_buffer(1, colors.slice(..));
                    pass.draw(0..4, first as u32..last as u32);
                }
            }
        }
    }

    fn upload(
        &mut self,
        renderer: &Renderer,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        camera: &Camera,
        upto: usize,
    ) {
        self.points.truncate(scene.points.len());
        while self.points.len() < scene.points.len() {
            self.points.push(PointsUpload::new(device, renderer));
        }
        for (upload, points) in self.points.iter_mut().zip(&scene.points) {
            upload.update(device, queue, points, upto);
        }
        let origin = scene.origin_in_world;
        let state = (
            scene.lines_generation,
            scene.lines.len(),
            origin.to_array().map(f64::to_bits),
        );
        if self.lines_state != Some(state) {
            let lines: Vec<LineInstance> = scene.lines.iter().map(|l| LineInstance::new(l, origin)).collect();
            self.lines
                .write(device, queue, "lines", bytemuck::cast_slice(&lines));
            self.lines_state = Some(state);
        }
        // Few, and their order depends on the camera.
        let planes = triangles(&scene.polygons, origin, camera.forward_in_world());
        self.planes
            .write(device, queue, "planes", bytemuck::cast_slice(&planes));
    }

    #[expect(clippy::too_many_arguments, reason = "as `draw`, whose part it is")]
    fn upload_view(
        &mut self,
        renderer: &Renderer,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        camera: &Camera,
        drawn_px: [u32; 2],
        oversampling: u32,
    ) {
        let [width, height] = drawn_px.map(f64::from);
        let (near, far) = camera.near_far(&scene.bounds);
        // Multiplied in f64: far from the world's origin both factors are large and their product small.
        let clip_from_local = camera.clip_from_world(Viewport::new(width, height), (near, far))
            * DMat4::from_translation(scene.origin_in_world);
        let color = |c: Color| c.map(|v| f32::from(v) / 255.0);
        let uniform = ViewUniform {
            clip_from_local: clip_from_local.as_mat4().to_cols_array(),
            size_px: [width as f32, height as f32],
            near: near as f32,
            far: far as f32,
            background_top: color(scene.background.top),
            background_bottom: color(scene.background.bottom),
            eye_dome_strength: scene.eye_dome.strength,
            eye_dome_scale: scene.eye_dome.scale.max(f32::MIN_POSITIVE),
            is_orthographic: f32::from(u8::from(camera.projection == Projection::Orthographic)),
            oversampling: oversampling as f32,
        };
        let (buffer, _) = self.view.get_or_insert_with(|| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("view"),
                size: size_of::<ViewUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("view"),
                layout: &renderer.view_layout,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: buffer.as_entire_binding(),
                }],
            });
            (buffer, group)
        });
        queue.write_buffer(buffer, 0, bytemuck::bytes_of(&uniform));
    }
}

impl Targets {
    fn new(renderer: &Renderer, device: &wgpu::Device, size_px: [u32; 2]) -> Self {
        let target = |label, format, extra| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width: size_px[0],
                    height: size_px[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | extra,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let (read, copied) = (
            wgpu::TextureUsages::TEXTURE_BINDING,
            wgpu::TextureUsages::COPY_SRC,
        );
        let points_color = target("points", COLOR, read);
        let depth = target("depth", DEPTH, read | copied);
        let overlaid_depth = target("overlaid depth", DEPTH, wgpu::TextureUsages::COPY_DST);
        let picture = target("picture", COLOR, read);
        let group = |label, layout, first, second| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(label),
                layout,
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: first,
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: second,
                    },
                ],
            })
        };
        let shading_group = group(
            "shading",
            &renderer.shading_layout,
            BindingResource::TextureView(&points_color),
            BindingResource::TextureView(&depth),
        );
        let composite_group = group(
            "composite",
            &renderer.composite_layout,
            BindingResource::TextureView(&picture),
            BindingResource::Sampler(&renderer.sampler),
        );
        Self {
            size_px,
            points_color,
            depth,
            overlaid_depth,
            picture,
            shading_group,
            composite_group,
        }
    }
}

/// Begins a pass into `color`. The target keeps its content if `depth` does.
fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    color: &wgpu::TextureView,
    depth: Option<(&wgpu::TextureView, bool)>,
) -> wgpu::RenderPass<'a> {
    let fresh = depth.is_none_or(|(_, fresh)| fresh);
    let load = if fresh {
        wgpu::LoadOp::Clear(wgpu::Color::BLACK)
    } else {
        wgpu::LoadOp::Load
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: depth.map(|(view, fresh)| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations {
                // Reversed depth: zero is farthest.
                load: if fresh {
                    wgpu::LoadOp::Clear(0.0)
                } else {
                    wgpu::LoadOp::Load
                },
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
