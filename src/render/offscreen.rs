//! A picture drawn without a window.

use super::gpu::OFFSCREEN_FORMAT;
use super::{Camera, Canvas, Extract, Gpu, Image, MAX_SIDE_PX, Scene};

/// The reason why a picture could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DrawError {
    /// A side is zero or too long.
    #[error(
        "a picture of {width_px} × {height_px} pixels cannot be drawn here: each side must have 1 to {most} pixels"
    )]
    Size {
        /// Pixels a row.
        width_px: u32,
        /// Rows.
        height_px: u32,
        /// The largest side of the adapter.
        most: u32,
    },
    /// The adapter ran out of memory, was unplugged, or refused.
    #[error("the graphics adapter failed: {0}")]
    Failed(String),
}

/// Draws a scene into memory, each pixel the mean of four where the adapter has room for that.
///
/// # Errors
/// Returns an error if the size is out of range, or if the adapter fails.
pub fn draw_image(
    gpu: &Gpu,
    scene: &Scene,
    camera: &Camera,
    width_px: u32,
    height_px: u32,
) -> Result<Image, DrawError> {
    let largest = gpu.device.limits().max_texture_dimension_2d;
    // Beyond some 8 million pixels no steps can be seen, and memory runs short.
    let small = u64::from(width_px) * u64::from(height_px) <= 8 << 20;
    let has_room = width_px.max(height_px) <= largest / 2;
    let oversampling = if small && has_room { 2 } else { 1 };
    draw_extract(
        gpu,
        scene,
        camera,
        &[Extract::whole([width_px, height_px], oversampling)],
    )
}

/// Draws parts of a scene into memory, one after the other; all of the first one's size.
///
/// # Errors
/// Returns an error if the size is out of range, if there is no part, or if the adapter fails.
pub fn draw_extract(
    gpu: &Gpu,
    scene: &Scene,
    camera: &Camera,
    extracts: &[Extract],
) -> Result<Image, DrawError> {
    let [width_px, height_px] = extracts.first().map_or([0, 0], |e| e.size_px);
    let most = gpu.device.limits().max_texture_dimension_2d.min(MAX_SIDE_PX);
    if !(1..=most).contains(&width_px) || !(1..=most).contains(&height_px) {
        return Err(DrawError::Size {
            width_px,
            height_px,
            most,
        });
    }
    let out_of_memory = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let invalid = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("image"),
        size: wgpu::Extent3d {
            width: width_px,
            height: height_px,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: OFFSCREEN_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let target = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut canvas = Canvas::new();
    for extract in extracts {
        canvas.draw(
            &gpu.renderer,
            &gpu.device,
            &gpu.queue,
            &mut encoder,
            scene,
            camera,
            extract,
        );
    }
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("image"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        canvas.composite(&gpu.renderer, &mut pass);
    }
    let rgba = read_back(gpu, encoder, &texture, width_px, height_px);
    let errors = [
        pollster::block_on(invalid.pop()),
        pollster::block_on(out_of_memory.pop()),
    ];
    if let Some(error) = errors.into_iter().flatten().next() {
        return Err(DrawError::Failed(error.to_string()));
    }
    Ok(Image {
        width_px,
        height_px,
        rgba: rgba?,
    })
}

/// Copies a texture into memory, once everything before it has been drawn.
fn read_back(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    width_px: u32,
    height_px: u32,
) -> Result<Vec<u8>, DrawError> {
    let row = 4 * width_px;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(padded_row) * u64::from(height_px),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.slice(..).map_async(wgpu::MapMode::Read, move |mapped| {
        // Nobody listens any more only where this very function has failed already.
        let _ = sender.send(mapped);
    });
    let failed = |reason: String| DrawError::Failed(reason);
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .map_err(|error| failed(error.to_string()))?;
    receiver
        .recv()
        .map_err(|error| failed(error.to_string()))?
        .map_err(|error| failed(error.to_string()))?;
    let mapped = buffer
        .slice(..)
        .get_mapped_range()
        .map_err(|error| failed(error.to_string()))?;
    Ok(mapped
        .chunks_exact(padded_row as usize)
        .flat_map(|padded| &padded[..row as usize])
        .copied()
        .collect())
}
