//! The settings that survive a restart.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::state::{Settings, State};
use crate::app::source::Source;
use crate::app::true_axes::state::KeptTrueAxes;
use crate::files::{read_regular, write_whole};
use crate::view::Style;
use crate::view::{Coloring, Overlays, Theme};

/// The longest session that is read, in bytes.
const LONGEST: u64 = 64 << 20;

/// Settings, what was open, and how it was shown.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Session {
    /// The version of the format. A session of another version is not read.
    pub version: u32,
    /// Parameters, and the plane that was looked at.
    pub settings: Settings,
    /// The style in which clouds were drawn.
    pub style: KeptStyle,
    /// Files opened lately, the last one first.
    pub recent: Vec<PathBuf>,
    /// The files that were open.
    pub open: Vec<PathBuf>,
    /// The place of the one that was shown.
    pub current: Option<usize>,
    /// The sorting and the filter of the table of clouds.
    #[serde(rename = "folder")]
    pub many: crate::app::many::KeptMany,
    /// The scale of the interface.
    pub interface_scale: f32,
    /// The arrangement of the panels, as the window wrote it.
    pub layout: Option<String>,
    /// The annotator's name and choices.
    #[serde(rename = "annotating")]
    pub true_axes: KeptTrueAxes,
    /// The window's inner size in logical pixels.
    pub window_size: Option<[f32; 2]>,
}

/// A [`Style`] as it is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptStyle {
    coloring: Coloring,
    overlays: Overlays,
    theme: Theme,
    point_size: Option<f32>,
    eye_dome: bool,
}

impl Default for KeptStyle {
    fn default() -> Self {
        Style::default().into()
    }
}

impl From<Style> for KeptStyle {
    fn from(style: Style) -> Self {
        Self {
            coloring: style.coloring,
            overlays: style.overlays,
            theme: style.theme,
            point_size: style.point_size,
            eye_dome: style.eye_dome,
        }
    }
}

impl From<KeptStyle> for Style {
    fn from(kept: KeptStyle) -> Self {
        Self {
            coloring: kept.coloring,
            overlays: kept.overlays,
            theme: kept.theme,
            point_size: kept.point_size,
            eye_dome: kept.eye_dome,
        }
    }
}

/// The reason why a session could not be written or read: one sentence that names the file.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// The file cannot be read or written.
    #[error("{}: the settings could not be kept: {error}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// The file is no session.
    #[error("{}: the settings of the last session could not be read ({error}); they begin anew, and the file was kept as {}", path.display(), kept_as.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The file's new place.
        kept_as: PathBuf,
        /// The reason.
        error: serde_json::Error,
    },
}

impl Session {
    /// The version that this program writes.
    pub const VERSION: u32 = 1;

    /// A session as on the first start.
    pub fn first() -> Self {
        Self {
            version: Self::VERSION,
            interface_scale: 1.0,
            ..Self::default()
        }
    }

    /// The session of a running program.
    pub fn of(state: &State) -> Self {
        let files: Vec<(usize, PathBuf)> = state
            .entries
            .iter()
            .enumerate()
            .filter_map(|(i, entry)| match &entry.source {
                Source::File(path) => Some((i, std::path::absolute(path).unwrap_or_else(|_| path.clone()))),
                _ => None,
            })
            .collect();
        Self {
            version: Self::VERSION,
            settings: state.settings.clone(),
            style: state.style.clone().into(),
            recent: state.recent.clone(),
            current: files.iter().position(|(i, _)| Some(*i) == state.current),
            open: files.into_iter().map(|(_, path)| path).collect(),
            many: state.many.kept(),
            interface_scale: state.interface_scale,
            layout: None,
            true_axes: state.true_axes.kept(),
            window_size: None,
        }
    }

    /// The session that lies at `path`; the first one where there is none.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read. One that makes no sense, or is of another version, is moved aside, so
    /// that it is not overwritten.
    pub fn read(path: &Path) -> Result<Self, SessionError> {
        let io = |error| SessionError::Io {
            path: path.to_owned(),
            error,
        };
        let text = match read_regular(path, LONGEST) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Self::first()),
            Err(error) => return Err(io(error)),
        };
        match serde_json::from_slice::<Self>(&text) {
            Ok(session) if session.is_sound() => Ok(session),
            // What it says may mean something else, to another version of the program, which finds it again.
            Ok(other) => {
                let kept_as = path.with_extension(format!("version-{}.json", other.version));
                std::fs::rename(path, kept_as).map_err(io)?;
                Ok(Self::first())
            }
            Err(error) => {
                let kept_as = path.with_extension("unreadable.json");
                std::fs::rename(path, &kept_as).map_err(io)?;
                Err(SessionError::Unreadable {
                    path: path.to_owned(),
                    kept_as,
                    error,
                })
            }
        }
    }

    fn is_sound(&self) -> bool {
        self.version == Self::VERSION && self.settings.request.params.check().is_ok()
    }

    /// Writes the session aside and moves it to `path`, so that no half of one is ever there.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), SessionError> {
        let write = || {
            if let Some(folder) = path.parent() {
                std::fs::create_dir_all(folder)?;
            }
            let text = serde_json::to_string_pretty(self)?;
            write_whole(path, text.as_bytes()).map_err(|failed| failed.error)
        };
        write().map_err(|error| SessionError::Io {
            path: path.to_owned(),
            error,
        })
    }
}
