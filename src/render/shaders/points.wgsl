// Points as round sprites of a size in pixels: one instance a point.

struct PointsLook {
    diameter_px: f32,
}

@group(1) @binding(0) var<uniform> look: PointsLook;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) color: vec4<f32>,
    // Relative to the disc: its edge is at distance 1.
    @location(1) place: vec2<f32>,
}

@vertex
fn point_corner(
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3<f32>,
    @location(1) color: vec4<f32>,
) -> Corner {
    // A strip of two triangles around the disc.
    let place = vec2<f32>(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    var clip = view.clip_from_local * vec4<f32>(position, 1.0);
    let radius_ndc = look.diameter_px * view.oversampling / view.size_px;
    clip = vec4<f32>(clip.xy + place * radius_ndc * clip.w, clip.zw);
    return Corner(clip, color, place);
}

@fragment
fn point_color(in: Corner) -> @location(0) vec4<f32> {
    if dot(in.place, in.place) > 1.0 {
        discard;
    }
    return vec4<f32>(in.color.rgb, 1.0);
}
