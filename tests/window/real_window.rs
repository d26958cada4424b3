//! The real program on a real (virtual) screen: it opens, draws, answers a key and closes cleanly.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A virtual screen that goes when it is dropped.
struct Screen {
    server: Child,
    name: String,
}

impl Screen {
    fn open() -> Self {
        // The server picks a free number and writes it to its standard output.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is installed (scripts/test installs it)");
        let mut number = String::new();
        let mut output = std::io::BufReader::new(server.stdout.take().expect("piped"));
        std::io::BufRead::read_line(&mut output, &mut number).expect("it says its number");
        Self {
            server,
            name: format!(":{}", number.trim()),
        }
    }

    fn run(&self, program: &str, arguments: &[&str]) -> String {
        let output = Command::new(program)
            .args(arguments)
            .env("DISPLAY", &self.name)
            .output()
            .unwrap_or_else(|e| panic!("{program} is installed: {e}"));
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// How many different colors the screen shows.
    fn colors(&self, folder: &Path) -> usize {
        let picture = folder.join("screen.png");
        self.run("import", &["-window", "root", &picture.display().to_string()]);
        let count = self.run("identify", &["-format", "%k", &picture.display().to_string()]);
        count.parse().unwrap_or(0)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // Already gone is as good.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn wait_for(what: &str, patience: Duration, mut is_there: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_there() {
        assert!(began.elapsed() < patience, "{what} does not come");
        std::thread::sleep(Duration::from_millis(100));
    }
}

#[test]
fn it_opens_draws_answers_a_key_and_closes() {
    let screen = Screen::open();
    let home = tempfile::tempdir().expect("a folder");
    let mut program = Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .env("DISPLAY", &screen.name)
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", home.path())
        .env("XDG_CONFIG_HOME", home.path().join("config"))
        .env("XDG_RUNTIME_DIR", home.path())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let minute = Duration::from_mins(1);
    let mut window = String::new();
    wait_for("the window", minute, || {
        window = screen.run("xdotool", &["search", "--name", "Axiscope"]);
        !window.is_empty()
    });
    wait_for("the cloud's name in the title", minute, || {
        screen
            .run("xdotool", &["getwindowname", &window])
            .starts_with("pepper.ply")
    });
    // A cloud in two colors, shaded, on a gradient: hundreds of colors. Panels alone have some dozens.
    wait_for("the picture", minute, || screen.colors(home.path()) > 400);

    // No window manager gives it the keyboard.
    screen.run("xdotool", &["windowfocus", "--sync", &window]);
    screen.run("xdotool", &["key", "--clearmodifiers", "ctrl+q"]);
    let mut status = None;
    wait_for("the end", minute, || {
        status = program.try_wait().expect("it can be asked");
        status.is_some()
    });
    let output = program.wait_with_output().expect("it has ended");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(status.is_some_and(|s| s.success()), "{status:?}: {said}");
    assert!(!said.contains("panicked"), "{said}");
    let kept = home.path().join("config/axiscope/session.json");
    assert!(kept.exists(), "the session is kept");
}

#[test]
fn without_a_display_it_says_what_to_do() {
    let home = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .env("HOME", home.path())
        .env("XDG_CONFIG_HOME", home.path())
        .env("XDG_RUNTIME_DIR", home.path())
        .output()
        .expect("it starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("display") && said.contains("axiscope render"),
        "{said}"
    );
    assert!(!said.contains("panicked"), "{said}");
}

#[test]
fn without_a_driver_it_says_what_to_install() {
    let screen = Screen::open();
    let home = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .env("DISPLAY", &screen.name)
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", home.path())
        .env("XDG_CONFIG_HOME", home.path())
        .env("XDG_RUNTIME_DIR", home.path())
        // No Vulkan driver lies there; OpenGL may be as good as it likes.
        .env("VK_DRIVER_FILES", "/no/such/driver.json")
        .env("VK_ICD_FILENAMES", "/no/such/driver.json")
        .output()
        .expect("it starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("mesa-vulkan-drivers") && said.contains("axiscope render"),
        "{said}"
    );
    assert!(!said.contains("panicked"), "{said}");
}
