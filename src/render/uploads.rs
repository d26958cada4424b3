//! Buffers of a scene on the GPU, which are written again only when the scene has changed.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::scene::{Dash, Line, Points, Polygon};
use super::{Color, Renderer};

/// Points a buffer: few enough that sending one takes some milliseconds, so that a large cloud can be
/// sent over several frames.
const CHUNK: usize = 1 << 17;

/// A line as the shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct LineInstance {
    from_local: [f32; 3],
    to_local: [f32; 3],
    color: Color,
    outline_color: Color,
    look: [f32; 4],
}

impl LineInstance {
    pub(super) fn new(line: &Line, origin_in_world: DVec3) -> Self {
        let local = |p: DVec3| (p - origin_in_world).as_vec3().to_array();
        Self {
            from_local: local(line.from_in_world),
            to_local: local(line.to_in_world),
            color: line.color,
            outline_color: line.outline_color,
            look: [
                line.width_px,
                line.outline_px,
                f32::from(u8::from(line.dash == Dash::Dashed)),
                line.hidden_opacity,
            ],
        }
    }
}

/// A polygon's corner as the shader reads it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct PlaneVertex {
    position_local: [f32; 3],
    color: Color,
}

/// The polygons as triangles, those farthest along `forward` first: translucent colors add up in
/// that order.
pub(super) fn triangles(polygons: &[Polygon], origin_in_world: DVec3, forward: DVec3) -> Vec<PlaneVertex> {
    let depth = |p: &Polygon| {
        p.corners_in_world.iter().map(|c| c.dot(forward)).sum::<f64>()
            / p.corners_in_world.len().max(1) as f64
    };
    let mut sorted: Vec<&Polygon> = polygons.iter().collect();
    sorted.sort_by(|a, b| depth(b).total_cmp(&depth(a)));
    let mut vertices = Vec::new();
    for polygon in sorted {
        let vertex = |corner: DVec3| PlaneVertex {
            position_local: (corner - origin_in_world).as_vec3().to_array(),
            color: polygon.color,
        };
        if let [first, rest @ ..] = &polygon.corners_in_world[..] {
            for pair in rest.windows(2) {
                vertices.extend([vertex(*first), vertex(pair[0]), vertex(pair[1])]);
            }
        }
    }
    vertices
}

/// A vertex buffer that grows when it must.
#[derive(Default)]
pub(super) struct GrowingBuffer {
    buffer: Option<wgpu::Buffer>,
}

impl GrowingBuffer {
    pub(super) fn write(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, label: &str, bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        let size = bytes.len() as u64;
        let buffer = match self.buffer.take() {
            Some(buffer) if buffer.size() >= size => buffer,
            _ => device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.next_multiple_of(256),
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
        };
        queue.write_buffer(&buffer, 0, bytes);
        self.buffer = Some(buffer);
    }

    pub(super) fn get(&self) -> Option<&wgpu::Buffer> {
        self.buffer.as_ref()
    }
}

/// One chunk of a cloud.
pub(super) struct Chunk {
    pub(super) count: usize,
    positions_generation: Option<u64>,
    colors_generation: Option<u64>,
    pub(super) positions: GrowingBuffer,
    pub(super) colors: GrowingBuffer,
}

/// One cloud of points on the GPU.
pub(super) struct PointsUpload {
    count: usize,
    pub(super) chunks: Vec<Chunk>,
    look: wgpu::Buffer,
    pub(super) look_group: wgpu::BindGroup,
}

impl PointsUpload {
    pub(super) fn new(device: &wgpu::Device, renderer: &Renderer) -> Self {
        let look = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("points look"),
            size: 16,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let look_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("points look"),
            layout: &renderer.look_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: look.as_entire_binding(),
            }],
        });
        Self {
            count: 0,
            chunks: Vec::new(),
            look,
            look_group,
        }
    }

    /// Sends the changed chunks of the first `upto` points, in drawing order. There is no work per point if nothing has
    /// changed.
    pub(super) fn update(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        points: &Points,
        upto: usize,
    ) {
        queue.write_buffer(
            &self.look,
            0,
            bytemuck::cast_slice(&[points.size_px, 0.0, 0.0, 0.0]),
        );
        let count = points.positions.len().min(points.colors.len());
        if count != self.count {
            self.count = count;
            self.chunks.clear();
        }
        let stride = even_stride(count);
        // One step after the other: a remainder for each point would take most of the time.
        let order_from = |first: usize| {
            let begin = (first as u128 * stride as u128 % count.max(1) as u128) as usize;
            std::iter::successors(Some(begin), move |&place| Some((place + stride) % count))
        };
        let chunk_count = count.div_ceil(CHUNK);
        while self.chunks.len() < chunk_count {
            self.chunks.push(Chunk {
                count: CHUNK.min(count - CHUNK * self.chunks.len()),
                positions_generation: None,
                colors_generation: None,
                positions: GrowingBuffer::default(),
                colors: GrowingBuffer::default(),
            });
        }
        for (index, chunk) in self.chunks.iter_mut().enumerate() {
            let first = index * CHUNK;
            if first >= upto {
                break;
            }
            if chunk.positions_generation != Some(points.positions_generation) {
                let flat: Vec<[f32; 3]> = order_from(first)
                    .take(chunk.count)
                    .map(|place| points.positions[place].to_array())
                    .collect();
                chunk
                    .positions
                    .write(device, queue, "positions", bytemuck::cast_slice(&flat));
                chunk.positions_generation = Some(points.positions_generation);
            }
            if chunk.colors_generation != Some(points.colors_generation) {
                let colors: Vec<Color> = order_from(first)
                    .take(chunk.count)
                    .map(|place| points.colors[place])
                    .collect();
                chunk
                    .colors
                    .write(device, queue, "colors", bytemuck::cast_slice(&colors));
                chunk.colors_generation = Some(points.colors_generation);
            }
        }
    }
}

/// A step through `count` points that visits each once, and whose every beginning is spread evenly
/// over them: near the golden section, and without a common factor with the count.
fn even_stride(count: usize) -> usize {
    let mut stride = ((count as f64 * 0.618_033_988_75) as usize).max(1);
    while gcd(stride, count) > 1 {
        stride += 1;
    }
    stride
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
