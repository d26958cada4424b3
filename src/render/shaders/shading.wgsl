// Eye-dome lighting over the points, and the background where there are none.

@group(1) @binding(0) var points_color: texture_2d<f32>;
@group(1) @binding(1) var points_depth: texture_depth_2d;

@vertex
fn shading_corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return covering_corner(index);
}

// Depth along the line of sight from the reversed depth that is stored.
fn depth_from_stored(stored: f32) -> f32 {
    if view.is_orthographic > 0.5 {
        return view.far - stored * (view.far - view.near);
    }
    return view.near * view.far / (view.near + stored * (view.far - view.near));
}

@fragment
fn shaded(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    let stored = textureLoad(points_depth, pixel, 0);
    if stored <= 0.0 {
        let down = at.y / view.size_px.y;
        return vec4<f32>(mix(view.background_top.rgb, view.background_bottom.rgb, down), 1.0);
    }
    let color = textureLoad(points_color, pixel, 0).rgb;
    if view.eye_dome_strength <= 0.0 {
        return vec4<f32>(color, 1.0);
    }
    let depth = depth_from_stored(stored);
    let last = vec2<i32>(view.size_px) - 1;
    let reach = 1.5 * view.oversampling;
    var sum = 0.0;
    for (var i = 0; i < 8; i++) {
        let turn = f32(i) * 0.78539816;
        let offset = vec2<i32>(round(reach * vec2<f32>(cos(turn), sin(turn))));
        let neighbor = textureLoad(points_depth, clamp(pixel + offset, vec2<i32>(0), last), 0);
        // Nothing there hides nothing.
        if neighbor > 0.0 {
            let step = (depth - depth_from_stored(neighbor)) / view.eye_dome_scale;
            // One deep step must not paint an edge black.
            sum += clamp(step, 0.0, 0.12);
        }
    }
    let shade = exp(-view.eye_dome_strength * 3.0 * sum);
    return vec4<f32>(color * max(shade, 0.45), 1.0);
}
