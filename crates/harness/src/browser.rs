//! A browser without a window, for tests of pages.

use crate::Need;
use serde_json::Value;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use wait_timeout::ChildExt;

/// A browser.
pub const BROWSER: Need = Need { tests: "browser tests", required_by: "ATROUS_REQUIRE_BROWSER" };
/// Names that Chromium has on this system or another.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
/// A page takes a second. A machine under load takes long; a browser that hangs is found out.
const PATIENCE: Duration = Duration::from_secs(120);

/// Catches what fails, before anything of the page runs.
const WATCH: &str = "<script>
const problems = [];
addEventListener('error', (e) => problems.push(e.message || 'cannot load ' + e.target.outerHTML.slice(0, 100)), true);
addEventListener('unhandledrejection', (e) => problems.push(String(e.reason)));
addEventListener('securitypolicyviolation', (e) => problems.push(e.violatedDirective + ' ' + e.blockedURI));
</script>";

/// A browser that runs pages.
pub struct Chromium {
    program: &'static str,
    folder: PathBuf,
}

impl Chromium {
    /// The first one that shows a page. `folder`: one for its files, that it may read wherever it comes from: `CARGO_TARGET_TMPDIR`.
    ///
    /// # Errors
    /// Says what is missing. On Ubuntu a program may be there that only tells to install a snap.
    pub fn find(folder: &Path) -> Result<Self, String> {
        let mut problems = Vec::new();
        for program in NAMES {
            let browser = Self { program, folder: folder.to_owned() };
            match browser.dump("<p>It works.</p>") {
                Ok(dom) if dom.contains("<p>It works.</p>") => return Ok(browser),
                Ok(dom) => problems.push(format!("{program} gives {dom:?}")),
                Err(problem) => problems.push(problem),
            }
        }
        Err(format!("no browser of the Chromium family works (Debian: apt install chromium): {}", problems.join("; ")))
    }

    /// Opens a page of `extent` pixels, and gives back what `script`, the body of a function, returns once all is loaded. The test
    /// fails with any error in the page.
    ///
    /// The browser prints the elements as soon as the window has loaded, and the frame has loaded before: a script that waits for
    /// nothing is done by then, on a slow machine too.
    pub fn observe(&self, html: &str, extent: [u32; 2], script: &str) -> Value {
        let run = format!(
            "<script>addEventListener('load', () => {{
                const observed = document.createElement('script');
                observed.type = 'observed';
                let seen = null;
                try {{ seen = (() => {{ {script} }})(); }} catch (e) {{ problems.push(String(e)); }}
                observed.textContent = JSON.stringify([problems, seen]);
                parent.document.body.append(observed);
            }});</script>"
        );
        let html = html.replacen("<head>", &format!("<head>{WATCH}"), 1).replacen("</body>", &format!("{run}</body>"), 1);
        // In a frame: no window is as narrow as a phone. The outer page is the file, whose encoding a browser would guess.
        let [width, height] = extent;
        let html = html.replace('&', "&amp;").replace('"', "&quot;");
        let html = format!(
            "<!DOCTYPE html><meta charset=\"utf-8\"><body><iframe width={width} height={height} style=\"border:0\" srcdoc=\"{html}\"></iframe></body>"
        );
        let dom = self.dump(&html).unwrap_or_else(|problem| panic!("{problem}"));
        let json = dom.rsplit_once("<script type=\"observed\">").and_then(|(_, rest)| rest.split_once("</script>"));
        let (json, _) = json.unwrap_or_else(|| panic!("the script did not run: the browser gave {} bytes", dom.len()));
        let [problems, seen] = serde_json::from_str::<[Value; 2]>(json).expect("JSON");
        assert_eq!(problems, Value::Array(Vec::new()), "errors in the page");
        seen
    }

    /// The elements of a page after its scripts ran.
    fn dump(&self, html: &str) -> Result<String, String> {
        let program = self.program;
        let io = |e: std::io::Error| format!("{program}: {e}");
        let folder = tempfile::tempdir_in(&self.folder).map_err(io)?;
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("page.html"), html).map_err(io)?;
        // Into a file: a pipe that nobody empties would stop the browser.
        let output = File::create(at("dom")).map_err(io)?;
        let mut child = Command::new(program)
            .args(["--headless", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--hide-scrollbars"])
            // Tests may run as root, for whom Chromium has no sandbox; the page is ours.
            .arg("--no-sandbox")
            .arg(format!("--user-data-dir={}", at("profile").display()))
            .args(["--window-size=1600,1200", "--dump-dom"])
            .arg(address(&at("page.html")))
            .stdin(Stdio::null())
            .stdout(output)
            .stderr(File::create(at("log")).map_err(io)?)
            .spawn()
            .map_err(io)?;
        let ended = child.wait_timeout(PATIENCE).map_err(io)?;
        if ended.is_none() {
            child.kill().and_then(|()| child.wait()).map_err(io)?;
        }
        match ended {
            Some(status) if status.success() => std::fs::read_to_string(at("dom")).map_err(io),
            Some(status) => {
                let log = std::fs::read_to_string(at("log")).unwrap_or_default();
                Err(format!("{program}: {status}: {}", log.lines().last().unwrap_or_default()))
            }
            None => Err(format!("{program} did not end in {} s", PATIENCE.as_secs())),
        }
    }
}

fn address(path: &Path) -> String {
    // The folder of the build may have a space in its name.
    format!("file://{}", path.display().to_string().replace('%', "%25").replace('#', "%23").replace('?', "%3F").replace(' ', "%20"))
}
