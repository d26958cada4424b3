// The finished picture onto somebody's target, oversampled pixels averaged.

@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var smooth_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
}

@vertex
fn composite_corner(@builtin(vertex_index) index: u32) -> Corner {
    let clip = covering_corner(index);
    return Corner(clip, vec2<f32>(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y));
}

@fragment
fn composite_color(in: Corner) -> @location(0) vec4<f32> {
    // With twice the pixels each way the middle between four is their mean.
    return vec4<f32>(textureSampleLevel(picture, smooth_sampler, in.place, 0.0).rgb, 1.0);
}
