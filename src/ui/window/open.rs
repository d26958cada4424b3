//! Opens the window on this desktop.

use std::path::PathBuf;

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};

use crate::app::Session;
use crate::ui::window::{Start, Window};

/// The reason why the window could not be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// No display is available.
    #[error(
        "there is no display to open a window on ({0}); set DISPLAY or WAYLAND_DISPLAY, or draw pictures without a window: axiscope render CLOUD -o PICTURE.png"
    )]
    NoDisplay(String),
    /// No graphics adapter is available.
    #[error(
        "no graphics adapter can draw the window ({0}); install a Vulkan driver, for instance Mesa's software driver (on Debian and Ubuntu: apt install mesa-vulkan-drivers). “axiscope render” draws pictures without a window, and the other commands need no graphics at all"
    )]
    NoAdapter(String),
    /// The window could not be set up.
    #[error("the window could not be opened: {0}")]
    Other(String),
}

/// Returns the path of the stored session; `None` without a home directory.
pub fn session_path() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "axiscope")?;
    Some(folders.config_dir().join("session.json"))
}

/// Returns the folder of cached rows and pictures; `None` without a home directory.
fn cache_path() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "axiscope")?;
    Some(folders.cache_dir().join("clouds"))
}

/// Returns the file of the clouds that were shown with results; `None` without a home directory.
fn seen_path() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "axiscope")?;
    Some(folders.data_dir().join("shown-with-results.txt"))
}

/// Opens a window on `paths`, or on the clouds of the last session, or on a sample; returns when it is closed. With
/// `is_blind` nothing computed is shown from the first frame on.
///
/// # Errors
/// Returns an error if no display or no graphics adapter is available.
pub fn open_window(paths: Vec<PathBuf>, is_blind: bool) -> Result<(), OpenError> {
    let session_path = session_path();
    let (mut session, problem) = match session_path.as_deref().map(Session::read) {
        None => (Session::first(), None),
        Some(Ok(session)) => (session, None),
        Some(Err(error)) => (Session::first(), Some(format!("{error}."))),
    };
    session.true_axes.is_blind |= is_blind;
    let size = session.window_size.unwrap_or([1360.0, 860.0]);
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    // OpenGL cannot draw the points: an error message is better than a crash.
    setup.instance_descriptor.backends &= wgpu::Backends::PRIMARY;
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Axiscope")
            .with_app_id("axiscope")
            .with_inner_size(size)
            .with_min_inner_size([640.0, 420.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration {
            wgpu_setup: WgpuSetup::CreateNew(setup),
            ..Default::default()
        },
        persist_window: false,
        ..Default::default()
    };
    let start = Start {
        session,
        session_path,
        paths,
        problem,
    };
    eframe::run_native(
        "Axiscope",
        options,
        Box::new(|context| {
            let mut window = Window::new(context, start)?;
            if let Some(folder) = cache_path() {
                window.app_mut().keep_rows_in(folder);
            }
            if let Some(path) = seen_path() {
                window.app_mut().keep_seen_in(path);
            }
            Ok(Box::new(window))
        }),
    )
    .map_err(|error| match error {
        eframe::Error::WinitEventLoop(error) => OpenError::NoDisplay(error.to_string()),
        eframe::Error::Winit(error) => OpenError::NoDisplay(error.to_string()),
        eframe::Error::Wgpu(error) => OpenError::NoAdapter(error.to_string()),
        eframe::Error::AppCreation(error) => OpenError::Other(error.to_string()),
    })
}
