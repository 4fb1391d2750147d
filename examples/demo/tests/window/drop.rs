//! Files that are dropped on the window, as a file manager does it: by the protocol XDND, version 5.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode, SelectionNotifyEvent, SelectionRequestEvent,
    Window, WindowClass, SELECTION_NOTIFY_EVENT,
};
use x11rb::protocol::Event;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{COPY_DEPTH_FROM_PARENT, COPY_FROM_PARENT, CURRENT_TIME, NONE};

use crate::session::{Demo, Display};

x11rb::atom_manager! {
    Atoms: AtomsCookie {
        XdndSelection,
        XdndEnter,
        XdndPosition,
        XdndStatus,
        XdndDrop,
        XdndFinished,
        XdndActionCopy,
        UriList: b"text/uri-list",
        WM_PROTOCOLS,
        WM_DELETE_WINDOW,
    }
}

/// As long as a line of the log may take.
const PATIENCE: Duration = Duration::from_secs(240);

/// A window that files are dragged from.
struct Source {
    connection: RustConnection,
    atoms: Atoms,
    window: Window,
    target: Window,
}

impl Source {
    fn new(demo: &Demo) -> Self {
        let (display, target) = demo.window();
        let (connection, screen) = x11rb::connect(Some(display)).expect("the X server");
        let root = connection.setup().roots[screen].root;
        let window = connection.generate_id().expect("a number");
        let (depth, class, values) = (COPY_DEPTH_FROM_PARENT, WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
        connection.create_window(depth, window, root, 0, 0, 1, 1, 0, class, COPY_FROM_PARENT, &values).expect("a window");
        let atoms = Atoms::new(&connection).expect("a request").reply().expect("atoms");
        connection.set_selection_owner(window, atoms.XdndSelection, CURRENT_TIME).expect("a request");
        Self { connection, atoms, window, target }
    }

    fn send(&self, kind: u32, data: [u32; 5]) {
        let message = ClientMessageEvent::new(32, self.target, kind, data);
        self.connection.send_event(false, self.target, EventMask::NO_EVENT, message).expect("a request");
        self.connection.flush().expect("the X server");
    }

    /// Drags a file over the target, waits until it has asked which, and drops it. Whether the target took it.
    fn drop_file(&self, path: &Path) -> bool {
        let atoms = &self.atoms;
        self.send(atoms.XdndEnter, [self.window, 5 << 24, atoms.UriList, NONE, NONE]);
        self.send(atoms.XdndPosition, [self.window, 0, 100 << 16 | 100, CURRENT_TIME, atoms.XdndActionCopy]);
        let (mut is_asked, mut is_welcome) = (false, false);
        while !(is_asked && is_welcome) {
            match self.next_event() {
                Event::SelectionRequest(request) => {
                    self.answer(&request, path);
                    is_asked = true;
                }
                Event::ClientMessage(m) if m.type_ == atoms.XdndStatus => is_welcome = m.data.as_data32()[1] & 1 == 1,
                _ => {}
            }
        }
        self.send(atoms.XdndDrop, [self.window, 0, CURRENT_TIME, 0, 0]);
        loop {
            match self.next_event() {
                Event::ClientMessage(m) if m.type_ == atoms.XdndFinished => return m.data.as_data32()[1] & 1 == 1,
                _ => {}
            }
        }
    }

    fn answer(&self, request: &SelectionRequestEvent, path: &Path) {
        let path = path.to_str().expect("UTF-8").replace('%', "%25").replace(' ', "%20");
        let uris = format!("file://{path}\r\n");
        let (requestor, property) = (request.requestor, request.property);
        let connection = &self.connection;
        connection
            .change_property8(PropMode::REPLACE, requestor, property, self.atoms.UriList, uris.as_bytes())
            .expect("a request");
        let answer = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor,
            selection: request.selection,
            target: request.target,
            property,
        };
        connection.send_event(false, requestor, EventMask::NO_EVENT, answer).expect("a request");
        connection.flush().expect("the X server");
    }

    fn next_event(&self) -> Event {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(event) = self.connection.poll_for_event().expect("the X server") {
                return event;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("the window does not answer");
    }

    /// As a window manager closes a window.
    fn close_target(&self) {
        self.send(self.atoms.WM_PROTOCOLS, [self.atoms.WM_DELETE_WINDOW, CURRENT_TIME, 0, 0, 0]);
    }
}

/// A triangle, with its buffer beside the file.
fn triangle(folder: &Path, name: &str) -> PathBuf {
    let positions: [f32; 9] = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0];
    let bytes: Vec<u8> = positions.iter().flat_map(|value| value.to_le_bytes()).collect();
    fs::write(folder.join("triangle.bin"), bytes).expect("a buffer");
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"uri":"triangle.bin","byteLength":36}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}]}"#;
    let path = folder.join(name);
    fs::write(&path, json).expect("a file");
    path
}

#[test]
fn a_dropped_file_is_the_scene_and_a_broken_one_is_not() {
    let Some(display) = Display::open() else { return };
    let out = crate::folder("window-drop");
    let whole = triangle(&out, "one triangle.gltf");
    let broken = out.join("broken.gltf");
    fs::write(&broken, b"{}").expect("a file");

    let mut demo = Demo::start(&display, &out);
    demo.wait("frames", |line| line.starts_with("frame") && line.contains("scene=cornell"));
    demo.focus();
    let source = Source::new(&demo);
    assert!(source.drop_file(&whole), "refused");
    let is_dropped = |line: &str| line.starts_with("frame") && line.contains("scene=one triangle");
    demo.wait("the scene of the file", is_dropped);

    assert!(source.drop_file(&broken), "refused");
    demo.wait("what is wrong", |line| line.starts_with("error") && line.contains("broken.gltf"));
    for _ in 0..3 {
        let frame = demo.wait("a frame", |line| line.starts_with("frame"));
        assert!(is_dropped(&frame), "the old scene stays: {frame}");
    }
    demo.key("ctrl+s");
    demo.wait("settings", |line| line.starts_with("message settings are in"));
    let saved = fs::read_to_string(out.join("settings.json")).expect("settings");
    assert!(saved.contains("one triangle.gltf") && !saved.contains("broken.gltf"), "{saved}");

    triangle(&out, "broken.gltf");
    assert!(source.drop_file(&broken), "refused");
    demo.wait("the file that was mended", |line| line.starts_with("frame") && line.contains("scene=broken"));
    source.close_target();
    demo.assert_closed();
}
