//! An X server of our own, and the program in it.

use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use crate::screen::Screen;

/// A machine under load takes long; one that hangs is found out.
const PATIENCE: Duration = Duration::from_secs(240);
const POLL: Duration = Duration::from_millis(20);

/// A virtual X server, gone with this value.
pub struct Display {
    server: Child,
    name: String,
    folder: PathBuf,
}

impl Display {
    /// `None`, said on the terminal, where there is no Xvfb or xdotool; an error with `ATROUS_REQUIRE_DEVICE=1`.
    pub fn open() -> Option<Self> {
        match Self::start() {
            Ok(display) => Some(display),
            Err(problem) => {
                assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {problem}");
                eprintln!("SKIPPED: {problem} (Debian, Ubuntu: apt install xvfb xdotool)");
                None
            }
        }
    }

    fn start() -> Result<Self, String> {
        Command::new("xdotool").arg("version").output().map_err(|e| format!("xdotool: {e}"))?;
        static OPENED: AtomicU32 = AtomicU32::new(0);
        let name = format!("display-{}-{}", std::process::id(), OPENED.fetch_add(1, Ordering::Relaxed));
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
        // The server picks a free number and says which.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1000x600x24", "-nolisten", "tcp", "-fbdir"])
            .arg(&folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| format!("Xvfb: {e}"))?;
        let mut number = String::new();
        let stdout = server.stdout.take().ok_or("Xvfb has no output")?;
        BufReader::new(stdout).read_line(&mut number).map_err(|e| e.to_string())?;
        if number.trim().is_empty() {
            return Err(format!("Xvfb does not start: {:?}", server.wait()));
        }
        Ok(Self { server, name: format!(":{}", number.trim()), folder })
    }

    /// What is on the screen now.
    pub fn screen(&self) -> Screen {
        let path = self.folder.join("Xvfb_screen0");
        Screen::parse(&std::fs::read(path).expect("the screen"))
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// What a line says of the panel's width.
pub fn panel_width_of(line: &str) -> Option<f32> {
    line.split("panel_width=").nth(1)?.split(' ').next()?.parse().ok()
}

/// The program with its window.
pub struct Demo {
    child: Child,
    display: String,
    log: PathBuf,
    /// Bytes of the log that were read.
    read: u64,
    /// Lines that were read, for the message of a failure.
    lines: Vec<String>,
    picture: [f32; 4],
    panel_width: f32,
    window: String,
}

impl Demo {
    /// Starts it on small pictures, under validation.
    pub fn start(display: &Display, out: &Path) -> Self {
        let log = out.join("log");
        let child = Command::new(env!("CARGO_BIN_EXE_atrous-demo"))
            .args(["--window", "--validate", "--scene", "cornell", "--size", "64x36", "--window-size", "900x500"])
            .arg("--settings")
            .arg(out.join("settings.json"))
            .arg("--out")
            .arg(out)
            .arg("--window-log")
            .arg(&log)
            .env("DISPLAY", &display.name)
            .envs(atrous_harness::quick_shaders())
            .env_remove("WAYLAND_DISPLAY")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the demo starts");
        let display = display.name.clone();
        Self { child, display, log, read: 0, lines: Vec::new(), picture: [0.0; 4], panel_width: 0.0, window: String::new() }
    }

    /// Waits for a line that was written after those that were waited for before.
    pub fn wait(&mut self, what: &str, wanted: impl Fn(&str) -> bool) -> String {
        let start = Instant::now();
        loop {
            if let Some(line) = self.read_line() {
                if wanted(&line) {
                    return line;
                }
                continue;
            }
            let ended = self.child.try_wait().expect("a child");
            let late = start.elapsed() > PATIENCE;
            if ended.is_some() || late {
                let telling: Vec<&str> = self.lines.iter().map(String::as_str).filter(|l| !l.starts_with("frame")).collect();
                let tail = [&telling[telling.len().saturating_sub(15)..], &[self.lines.last().map_or("", String::as_str)]]
                    .concat()
                    .join("\n");
                let _ = self.child.kill();
                panic!("waiting for {what}: {ended:?}; the log ends with\n{tail}\n{}", self.errors());
            }
            std::thread::sleep(POLL);
        }
    }

    fn read_line(&mut self) -> Option<String> {
        let line = self.next_line()?;
        if let Some(numbers) = line.strip_prefix("picture ") {
            let parsed: Vec<f32> = numbers.split(' ').filter_map(|n| n.parse().ok()).collect();
            self.picture.copy_from_slice(&parsed[..4]);
        }
        self.panel_width = panel_width_of(&line).unwrap_or(self.panel_width);
        self.lines.push(line.clone());
        Some(line)
    }

    fn next_line(&mut self) -> Option<String> {
        let mut file = std::fs::File::open(&self.log).ok()?;
        file.seek(SeekFrom::Start(self.read)).ok()?;
        let mut line = String::new();
        BufReader::new(file).read_line(&mut line).ok()?;
        let complete = line.ends_with('\n');
        complete.then(|| {
            self.read += line.len() as u64;
            line.trim_end().to_owned()
        })
    }

    fn errors(&mut self) -> String {
        let mut text = String::new();
        if let Some(mut stderr) = self.child.stderr.take() {
            let _ = stderr.read_to_string(&mut text);
        }
        text
    }

    /// The X server, and the window that [`Self::focus`] found in it.
    pub fn window(&self) -> (&str, u32) {
        (&self.display, self.window.parse().expect("a number"))
    }

    /// Where the picture was last, window pixels: corner and size.
    pub fn picture(&self) -> [f32; 4] {
        self.picture
    }

    /// The width that the panel had last, window pixels; 0 where it is hidden.
    pub fn panel_width(&self) -> f32 {
        self.panel_width
    }

    /// Finds the window and gives it the keyboard; there is no window manager that would.
    pub fn focus(&mut self) {
        let found = self.xdotool(&["search", "--sync", "--name", "^atrous$"]);
        self.window = found.lines().next().expect("a window").to_owned();
        let window = self.window.clone();
        self.xdotool(&["windowmove", &window, "0", "0"]);
        self.take_keyboard();
    }

    /// Keys go to the window, and it knows.
    fn take_keyboard(&mut self) {
        self.catch_up();
        self.xdotool(&["windowfocus", &self.window]);
        self.wait("the keyboard", |line| line == "focused true");
    }

    /// What is waited for from here on comes after what was done from here on.
    fn catch_up(&mut self) {
        while self.read_line().is_some() {}
    }

    fn xdotool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output().expect("xdotool");
        assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Presses a key.
    pub fn key(&mut self, key: &str) {
        self.catch_up();
        self.xdotool(&["key", key]);
    }

    /// Holds a key meanwhile.
    pub fn hold(&mut self, key: &str, meanwhile: impl FnOnce(&mut Self)) {
        self.catch_up();
        self.xdotool(&["keydown", key]);
        meanwhile(self);
        self.xdotool(&["keyup", key]);
    }

    /// Moves the mouse to a point of the window.
    pub fn point(&mut self, [x, y]: [f32; 2]) {
        self.catch_up();
        self.xdotool(&["mousemove", "--window", &self.window, &(x as i32).to_string(), &(y as i32).to_string()]);
    }

    /// Drags the divider with the left button, once the program has seen that it is held.
    pub fn drag_divider(&mut self, from: [f32; 2], to: [f32; 2]) {
        let held = |demo: &mut Self| {
            demo.wait("a hold on the divider", |line| line.starts_with("state") && line.ends_with("held=true"));
        };
        self.drag(from, to, held, |_| ());
    }

    /// Drags with the left button; `held` is called while it is down where it was pressed, `moved` while it is down where it ends.
    pub fn drag(&mut self, from: [f32; 2], to: [f32; 2], held: impl FnOnce(&mut Self), moved: impl FnOnce(&mut Self)) {
        self.point(from);
        self.xdotool(&["mousedown", "1"]);
        held(self);
        for step in 1..=4 {
            let at = |i: usize| from[i] + (to[i] - from[i]) * step as f32 / 4.0;
            self.point([at(0), at(1)]);
            std::thread::sleep(POLL);
        }
        moved(self);
        self.xdotool(&["mouseup", "1"]);
    }

    /// Another size.
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        self.catch_up();
        self.xdotool(&["windowsize", &self.window, &width.to_string(), &height.to_string()]);
    }

    /// As a window manager hides a window and shows it again.
    pub fn hide_and_show(&mut self) {
        self.xdotool(&["windowunmap", "--sync", &self.window]);
        self.xdotool(&["windowmap", "--sync", &self.window]);
        self.take_keyboard();
    }

    /// It ends well, has freed everything, and validation had nothing to say.
    pub fn assert_closed(&mut self) {
        self.wait("the end", |line| line == "closed validation=0");
        let status = self.child.wait().expect("a child");
        let errors = self.errors();
        assert!(status.success() && errors.is_empty(), "{status}: {errors}");
    }
}

impl Drop for Demo {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
