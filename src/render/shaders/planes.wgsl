// Flat translucent polygons.

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) color: vec4<f32>,
}

@vertex
fn plane_corner(@location(0) position: vec3<f32>, @location(1) color: vec4<f32>) -> Corner {
    return Corner(view.clip_from_local * vec4<f32>(position, 1.0), color);
}

@fragment
fn plane_color(in: Corner) -> @location(0) vec4<f32> {
    return in.color;
}
