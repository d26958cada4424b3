//! Scans of a mesh from a file.

use std::path::PathBuf;

use axiscope::annotate::{Annotation, Role};
use axiscope::fruit::{AxisFiles, MeshFile, read_annotations, read_mesh};
use axiscope::geometry::Unit;
use axiscope::simulate::{MeshScanSettings, seeds};
use clap::Args;
use glam::DVec3;

use super::camera::{CameraOptions, ViewOptions};
use super::{Made, Output, set, write_all};
use crate::cli::options::{OrAuto, position, unit_or_auto};
use crate::cli::output::say;

#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct Scan {
    /// The mesh: PLY with faces, OBJ or STL
    mesh: PathBuf,
    #[command(flatten)]
    output: Output,
    /// Unit of the mesh's coordinates, and of the cloud's
    #[arg(long, default_value = "auto", value_parser = unit_or_auto(), help_heading = "Output")]
    unit: OrAuto<Unit>,

    /// The camera's place in the mesh's frame and unit [default: in front, at z where y is up, as far away as the
    /// mesh fills half of the image]
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true, help_heading = "Pose")]
    from: Option<DVec3>,
    /// The point in the middle of the image, around which a moving camera goes [default: the center of the box around
    /// the mesh]
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true, help_heading = "Pose")]
    towards: Option<DVec3>,
    /// The direction of the mesh that is up in the image: x, y, z, -x, -y, -z or X,Y,Z [default: y]
    #[arg(long, value_name = "UP", value_parser = direction, allow_hyphen_values = true, help_heading = "Pose")]
    up: Option<DVec3>,
    /// The true axis: the stem end and the blossom end in the mesh's frame and unit [default: the mesh's annotation,
    /// MESH.ANNOTATOR.axis.json beside it, else none and no truth file]
    #[arg(long, value_name = "X,Y,Z:X,Y,Z", value_parser = axis, allow_hyphen_values = true, help_heading = "Pose")]
    axis: Option<[DVec3; 2]>,

    #[command(flatten)]
    camera: CameraOptions,
    #[command(flatten)]
    views: ViewOptions,
}

pub(super) fn run(args: &Scan) -> anyhow::Result<()> {
    let file = read_mesh(&args.mesh, args.unit)?;
    for warning in &file.warnings {
        say!("Warning: {warning}");
    }
    let settings = args.settings(&file)?;
    let stem = args.mesh.file_stem().unwrap_or_default().to_string_lossy();
    let shape = format!("{stem}_scan");
    let seeds = seeds(args.output.seed, args.output.count as usize);
    let jobs = seeds.into_iter().enumerate().map(|(i, seed)| {
        let settings = MeshScanSettings {
            seed,
            ..settings.clone()
        };
        (format!("{shape}_{i:03}"), settings)
    });
    write_all(&args.output, &shape, &jobs.collect::<Vec<_>>(), |settings| {
        let scanned = settings.scan(&file.mesh)?;
        let (cloud, truth) = scanned.in_unit(file.unit);
        Ok(Made {
            cloud,
            unit: file.unit,
            seed: settings.seed,
            truth,
        })
    })
}

impl Scan {
    fn settings(&self, file: &MeshFile) -> anyhow::Result<MeshScanSettings> {
        let name = self.mesh.file_name().unwrap_or_default();
        let mut settings = MeshScanSettings {
            mesh_file: Some(name.to_string_lossy().into_owned()),
            mesh_sha256: Some(file.sha256.clone()),
            mesh_unit: file.unit,
            from: self.from,
            towards: self.towards,
            axis: self.axis.or_else(|| annotated_axis(file)),
            ..MeshScanSettings::default()
        };
        set(&mut settings.up, self.up);
        self.camera.apply(&mut settings.camera);
        self.views.apply(&mut settings.scan)?;
        Ok(settings)
    }
}

/// The axis that was set by hand: the adjudicated one, or that of the only annotator.
fn annotated_axis(file: &MeshFile) -> Option<[DVec3; 2]> {
    let (annotations, warnings) = read_annotations(&AxisFiles::default().of(&file.path), &file.sha256);
    for warning in warnings {
        say!("Warning: {warning}");
    }
    let adjudicated = annotations.iter().find(|a| a.role == Role::Adjudicator);
    if adjudicated.is_none() && annotations.len() > 1 {
        say!("Warning: several annotators set an axis, and none is adjudicated: give one by --axis.");
        return None;
    }
    let ends = adjudicated.or(annotations.first()).and_then(Annotation::ends)?;
    Some([ends.peduncle_base(), ends.blossom_end()])
}

fn direction(text: &str) -> Result<DVec3, String> {
    let (sign, letter) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    match letter {
        "x" => Ok(DVec3::X * sign),
        "y" => Ok(DVec3::Y * sign),
        "z" => Ok(DVec3::Z * sign),
        _ => position(text).map_err(|_| "expected x, y, z, -x, -y, -z or three numbers X,Y,Z".into()),
    }
}

fn axis(text: &str) -> Result<[DVec3; 2], String> {
    let (stem_end, blossom_end) = text
        .split_once(':')
        .ok_or("expected two points X,Y,Z:X,Y,Z with a colon between them")?;
    Ok([position(stem_end)?, position(blossom_end)?])
}
