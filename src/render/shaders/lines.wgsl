// Lines of a width in pixels with round ends, and discs, which are lines of no length: one instance
// a line.

struct LineIn {
    @location(0) from_local: vec3<f32>,
    @location(1) to_local: vec3<f32>,
    @location(2) color: vec4<f32>,
    @location(3) outline_color: vec4<f32>,
    // Width, outline, dashed (0 or 1), opacity where hidden.
    @location(4) look: vec4<f32>,
}

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) color: vec4<f32>,
    @location(1) @interpolate(flat) outline_color: vec4<f32>,
    // Half width, outline, dashed, length; pixels of the target.
    @location(2) @interpolate(flat) look: vec4<f32>,
    // Along the line from its start and across it, in pixels of the target.
    @location(3) @interpolate(linear) place: vec2<f32>,
    @location(4) @interpolate(flat) opacity: f32,
}

fn corner_of(index: u32, in: LineIn, opacity: f32) -> Corner {
    var a = view.clip_from_local * vec4<f32>(in.from_local, 1.0);
    var b = view.clip_from_local * vec4<f32>(in.to_local, 1.0);
    var out: Corner;
    // In front of the near plane there is no picture: cut there. Depth is reversed, so near is z = w.
    let ahead_a = a.w - a.z;
    let ahead_b = b.w - b.z;
    if (ahead_a < 0.0 && ahead_b < 0.0) || opacity <= 0.0 {
        out.clip = vec4<f32>(2.0, 2.0, 2.0, 1.0);
        return out;
    }
    if ahead_a < 0.0 {
        a = mix(a, b, ahead_a / (ahead_a - ahead_b));
    } else if ahead_b < 0.0 {
        b = mix(b, a, ahead_b / (ahead_b - ahead_a));
    }
    let half_size = 0.5 * view.size_px;
    let a_px = a.xy / a.w * half_size;
    let b_px = b.xy / b.w * half_size;
    let length_px = length(b_px - a_px);
    var along = vec2<f32>(1.0, 0.0);
    if length_px > 1e-3 {
        along = (b_px - a_px) / length_px;
    }
    let across = vec2<f32>(-along.y, along.x);
    let half_width = 0.5 * in.look.x * view.oversampling;
    let outline = in.look.y * view.oversampling;
    // A pixel more for the soft edge.
    let reach = half_width + outline + 1.0;
    let at_end = (index & 1u) == 1u;
    let side = select(-reach, reach, index >> 1u == 1u);
    let beyond = select(-reach, reach, at_end);
    let base = select(a, b, at_end);
    let offset_px = along * beyond + across * side;
    out.clip = vec4<f32>(base.xy + offset_px / half_size * base.w, base.zw);
    out.color = in.color;
    out.outline_color = in.outline_color;
    out.look = vec4<f32>(half_width, outline, in.look.z, length_px);
    out.place = vec2<f32>(select(0.0, length_px, at_end) + beyond, side);
    out.opacity = opacity;
    return out;
}

@vertex
fn seen_corner(@builtin(vertex_index) index: u32, in: LineIn) -> Corner {
    return corner_of(index, in, 1.0);
}

@vertex
fn hidden_corner(@builtin(vertex_index) index: u32, in: LineIn) -> Corner {
    return corner_of(index, in, in.look.w);
}

@fragment
fn line_color(in: Corner) -> @location(0) vec4<f32> {
    let length_px = in.look.w;
    let half_width = in.look.x;
    var from_px = 0.0;
    var to_px = length_px;
    if in.look.z > 0.5 {
        // Eight pixels of line, six of gap.
        let period = 14.0 * view.oversampling;
        from_px = floor(clamp(in.place.x, 0.0, length_px) / period) * period;
        to_px = min(from_px + 8.0 * view.oversampling, length_px);
    }
    let nearest = clamp(in.place.x, from_px, to_px);
    let distance_px = length(vec2<f32>(in.place.x - nearest, in.place.y));
    let covered = clamp(half_width + in.look.y + 0.5 - distance_px, 0.0, 1.0);
    if covered <= 0.0 {
        discard;
    }
    var color = in.color;
    if in.look.y > 0.0 {
        let inner = clamp(half_width + 0.5 - distance_px, 0.0, 1.0);
        color = mix(in.outline_color, in.color, inner);
    }
    return vec4<f32>(color.rgb, color.a * covered * in.opacity);
}
