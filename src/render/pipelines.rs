//! The pipelines, created once per device and target format.

use wgpu::{
    BindGroupLayout, BlendState, CompareFunction, PrimitiveTopology, RenderPipeline, TextureFormat,
    VertexAttribute, VertexBufferLayout, VertexStepMode, vertex_attr_array,
};

/// The color format of the targets before compositing. Its bytes are sRGB, so that colors keep their values and blend as
/// they do in windows and browsers.
pub(super) const COLOR: TextureFormat = TextureFormat::Rgba8Unorm;
pub(super) const DEPTH: TextureFormat = TextureFormat::Depth32Float;

const VIEW: &str = include_str!("shaders/view.wgsl");

/// Every shader with its name. [`Renderer`] puts the text of the first one before each of the others.
pub const SHADERS: [(&str, &str); 6] = [
    ("view", VIEW),
    ("points", include_str!("shaders/points.wgsl")),
    ("shading", include_str!("shaders/shading.wgsl")),
    ("lines", include_str!("shaders/lines.wgsl")),
    ("planes", include_str!("shaders/planes.wgsl")),
    ("composite", include_str!("shaders/composite.wgsl")),
];

/// The pipelines and layouts, which depend on neither scene nor camera. One per device and target format serves any number
/// of [`super::Canvas`]es.
pub struct Renderer {
    pub(super) points: RenderPipeline,
    pub(super) shading: RenderPipeline,
    pub(super) seen_lines: RenderPipeline,
    pub(super) hidden_lines: RenderPipeline,
    pub(super) planes: RenderPipeline,
    pub(super) composite: RenderPipeline,
    pub(super) view_layout: BindGroupLayout,
    pub(super) look_layout: BindGroupLayout,
    pub(super) shading_layout: BindGroupLayout,
    pub(super) composite_layout: BindGroupLayout,
    pub(super) sampler: wgpu::Sampler,
}

const POINT_POSITION: [VertexAttribute; 1] = vertex_attr_array![0 => Float32x3];
const POINT_COLOR: [VertexAttribute; 1] = vertex_attr_array![1 => Unorm8x4];
const LINE: [VertexAttribute; 5] =
    vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4, 4 => Float32x4];
const PLANE: [VertexAttribute; 2] = vertex_attr_array![0 => Float32x3, 1 => Unorm8x4];

/// The properties in which pipelines differ.
struct Recipe<'a> {
    name: &'a str,
    shader: &'a str,
    vertex: &'a str,
    fragment: &'a str,
    second_group: Option<&'a BindGroupLayout>,
    buffers: &'a [Option<VertexBufferLayout<'a>>],
    topology: PrimitiveTopology,
    /// Whether it writes depth, and its comparison.
    depth: Option<(bool, CompareFunction)>,
    blend: Option<BlendState>,
    format: TextureFormat,
}

impl Renderer {
    /// Creates all pipelines. `target_format` is the format of the target of [`super::Canvas::composite`].
    pub fn new(device: &wgpu::Device, target_format: TextureFormat) -> Self {
        let uniform = |label| layout(device, label, &[uniform_entry()]);
        let view_layout = uniform("view");
        let look_layout = uniform("points look");
        let (shading_layout, composite_layout) = (shading_layout(device), composite_layout(device));
        let make = |recipe: Recipe<'_>| pipeline(device, &view_layout, &recipe);
        let shader = |name| SHADERS.iter().find(|s| s.0 == name).map_or("", |s| s.1);
        let points = make(Recipe {
            name: "points",
            shader: shader("points"),
            vertex: "point_corner",
            fragment: "point_color",
            second_group: Some(&look_layout),
            buffers: &[
                Some(per_instance(12, &POINT_POSITION)),
                Some(per_instance(4, &POINT_COLOR)),
            ],
            topology: PrimitiveTopology::TriangleStrip,
            depth: Some((true, CompareFunction::Greater)),
            blend: None,
            format: COLOR,
        });
        let full_screen = |name, vertex, fragment, second_group, format| {
            make(Recipe {
                name,
                shader: shader(name),
                vertex,
                fragment,
                second_group: Some(second_group),
                buffers: &[],
                topology: PrimitiveTopology::TriangleList,
                depth: None,
                blend: None,
                format,
            })
        };
        let shading = full_screen("shading", "shading_corner", "shaded", &shading_layout, COLOR);
        let composite = full_screen(
            "composite",
            "composite_corner",
            "composite_color",
            &composite_layout,
            target_format,
        );
        let lines = |name, vertex, writes_depth, compare| {
            make(Recipe {
                name,
                shader: shader("lines"),
                vertex,
                fragment: "line_color",
                second_group: None,
                buffers: &[Some(per_instance(48, &LINE))],
                topology: PrimitiveTopology::TriangleStrip,
                depth: Some((writes_depth, compare)),
                blend: Some(BlendState::ALPHA_BLENDING),
                format: COLOR,
            })
        };
        let seen_lines = lines("seen lines", "seen_corner", true, CompareFunction::GreaterEqual);
        let hidden_lines = lines("hidden lines", "hidden_corner", false, CompareFunction::Less);
        let planes = make(Recipe {
            name: "planes",
            shader: shader("planes"),
            vertex: "plane_corner",
            fragment: "plane_color",
            second_group: None,
            buffers: &[Some(VertexBufferLayout {
                array_stride: 16,
                step_mode: VertexStepMode::Vertex,
                attributes: &PLANE,
            })],
            topology: PrimitiveTopology::TriangleList,
            depth: Some((false, CompareFunction::GreaterEqual)),
            blend: Some(BlendState::ALPHA_BLENDING),
            format: COLOR,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("composite"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self {
            points,
            shading,
            seen_lines,
            hidden_lines,
            planes,
            composite,
            view_layout,
            look_layout,
            shading_layout,
            composite_layout,
            sampler,
        }
    }
}

/// The inputs of the shading pass.
fn shading_layout(device: &wgpu::Device) -> BindGroupLayout {
    layout(
        device,
        "shading",
        &[
            texture_entry(0, wgpu::TextureSampleType::Float { filterable: false }),
            texture_entry(1, wgpu::TextureSampleType::Depth),
        ],
    )
}

/// The inputs of compositing.
fn composite_layout(device: &wgpu::Device) -> BindGroupLayout {
    layout(
        device,
        "composite",
        &[
            texture_entry(0, wgpu::TextureSampleType::Float { filterable: true }),
            wgpu::BindGroupLayoutEntry {
                binding: 1,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
                count: None,
            },
        ],
    )
}

fn per_instance(stride: u64, attributes: &[VertexAttribute]) -> VertexBufferLayout<'_> {
    VertexBufferLayout {
        array_stride: stride,
        step_mode: VertexStepMode::Instance,
        attributes,
    }
}

fn layout(device: &wgpu::Device, label: &str, entries: &[wgpu::BindGroupLayoutEntry]) -> BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries,
    })
}

fn uniform_entry() -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

fn texture_entry(binding: u32, sample_type: wgpu::TextureSampleType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

fn pipeline(device: &wgpu::Device, view_layout: &BindGroupLayout, recipe: &Recipe<'_>) -> RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(recipe.name),
        source: wgpu::ShaderSource::Wgsl(format!("{VIEW}\n{}", recipe.shader).into()),
    });
    let mut groups = vec![Some(view_layout)];
    groups.extend(recipe.second_group.map(Some));
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(recipe.name),
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(recipe.name),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(recipe.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: recipe.buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology: recipe.topology,
            ..Default::default()
        },
        depth_stencil: recipe.depth.map(|(writes, compare)| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(writes),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(recipe.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: recipe.format,
                blend: recipe.blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
