//! The reader of a mesh's file: PLY with faces, OBJ and STL.
//!
//! The two small formats are read here: of the crates that were tried, `tobj` overflows on relative indices out of range and
//! names no line in its errors, and `stl_io` takes binary files that start with "solid" for text. Both are the witnesses
//! of the tests.

mod error;
mod obj;
mod stl;

use std::path::{Path, PathBuf};

pub use error::MeshFormatError;

use super::cloud_file::bytes_of;
use super::{ReadError, ReadErrorKind, sha256_hex, unit_guess};
use crate::geometry::{Cloud, Unit};
use crate::ply;
use crate::simulate::TriangleMesh;

/// A mesh and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFile {
    /// The file's path, as it was given.
    pub path: PathBuf,
    /// SHA-256 of its bytes, in 64 lowercase hexadecimal digits.
    pub sha256: String,
    /// The triangles.
    pub mesh: TriangleMesh,
    /// The unit of its coordinates: the stated one, that of a PLY file's comment, or else a guess.
    pub unit: Unit,
    /// Warnings about the file, one or two sentences each.
    pub warnings: Vec<String>,
}

/// Vertices with their columns, and triangles.
type Parts = (Cloud, Vec<[u32; 3]>);

/// Reads a mesh with its unit (`None`: as stated in a PLY file, or else guessed).
///
/// # Errors
/// Returns an error if the file is missing, is not a regular file, cannot be read, is malformed, or has no triangles.
pub fn read_mesh(path: impl AsRef<Path>, unit: Option<Unit>) -> Result<MeshFile, ReadError> {
    let path = path.as_ref();
    read(path, unit).map_err(|kind| ReadError {
        path: path.to_owned(),
        kind,
    })
}

fn read(path: &Path, unit: Option<Unit>) -> Result<MeshFile, ReadErrorKind> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    let bytes = bytes_of(path, &())?;
    let mut warnings = Vec::new();
    let mut stated = unit;
    let (vertices, triangles): Parts = match ending.to_str() {
        Some("ply") => {
            let mesh = ply::read_mesh(&bytes)?;
            warnings.extend(mesh.vertices.notes.iter().map(|note| format!("{note}.")));
            stated = stated.or(mesh.vertices.stated_unit);
            (mesh.vertices.cloud, mesh.triangles)
        }
        Some("obj") => obj::parse(&bytes)?,
        Some("stl") => stl::parse(&bytes)?,
        _ => return Err(MeshFormatError::UnknownEnding.into()),
    };
    let mesh = TriangleMesh::of_cloud(&vertices, triangles)?;
    let (unit, _, doubt) = unit_guess::resolve(&vertices, stated);
    warnings.extend(doubt);
    Ok(MeshFile {
        path: path.to_owned(),
        sha256: sha256_hex(&bytes),
        mesh,
        unit,
        warnings,
    })
}

/// The lines of a text, with their numbers from 1, without comments.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, String)> {
    let lines = bytes.split(|&byte| byte == b'\n' || byte == b'\r');
    // A line end of two characters counts once.
    let mut number = 1;
    let mut at = 0;
    lines.map(move |line| {
        let this = number;
        at += line.len() + 1;
        let is_half = bytes.get(at - 1) == Some(&b'\r') && bytes.get(at) == Some(&b'\n');
        number += usize::from(!is_half);
        (this, String::from_utf8_lossy(line).into_owned())
    })
}

/// Three finite numbers at the start of some words.
fn three<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<[f64; 3]> {
    let mut next = || words.next()?.parse::<f64>().ok().filter(|x| x.is_finite());
    Some([next()?, next()?, next()?])
}
