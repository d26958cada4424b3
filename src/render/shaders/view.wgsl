// What every pass knows about the view. Put before each of the other shaders.

struct View {
    clip_from_local: mat4x4<f32>,
    // Physical pixels of the target that is drawn into.
    size_px: vec2<f32>,
    near: f32,
    far: f32,
    // sRGB, 0 to 1.
    background_top: vec4<f32>,
    background_bottom: vec4<f32>,
    eye_dome_strength: f32,
    eye_dome_scale: f32,
    is_orthographic: f32,
    // Pixels of the target to a pixel of the picture.
    oversampling: f32,
}

@group(0) @binding(0) var<uniform> view: View;

// A triangle that covers the whole target.
fn covering_corner(index: u32) -> vec4<f32> {
    return vec4<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
