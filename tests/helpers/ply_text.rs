//! Short PLY files for tests, of which only what matters is spelled out.

use axiscope::ply::{PlyCloud, read};

/// Reads a file of which only the header's middle and the body are given.
pub fn ascii(elements: &str, body: &str) -> PlyCloud {
    let file = format!("ply\nformat ascii 1.0\n{elements}\nend_header\n{body}");
    read(file.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{file}"))
}

/// A vertex element; the properties are parted by commas.
pub fn vertex(count: usize, properties: &str) -> String {
    let properties: Vec<String> = properties.split(", ").map(|p| format!("property {p}")).collect();
    format!("element vertex {count}\n{}", properties.join("\n"))
}

/// The properties of a bare position.
pub const XYZ: &str = "float x, float y, float z";
