//! Keys and what they do: one table for the window, the help and the tests.

use atrous::config::Preset;
use winit::keyboard::KeyCode;

use super::camera::Held;
use super::content::Content;

/// Something that a key or a button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Stops time, or lets it go on.
    Pause,
    /// One frame, then time stands still.
    Step,
    /// Drops all history.
    Reset,
    /// The camera goes back to its path.
    Home,
    /// Shows something left of the divider.
    Left(Content),
    /// Shows something right of it.
    Right(Content),
    /// Changes the halves.
    Swap,
    /// The error of the left half's filter, or that filter again.
    LeftError,
    /// The same of the right half.
    RightError,
    /// The difference of the halves on or off.
    Difference,
    /// Fit or integer scaling.
    Scaling,
    /// The magnifier on or off.
    Magnifier,
    /// The panel on or off.
    Panel,
    /// The help on or off.
    Help,
    /// Writes the picture.
    Screenshot,
    /// Starts or ends writing every frame.
    Record,
    /// Starts or ends recording the camera's way.
    RecordPath,
    /// Flies the recorded way.
    ReplayPath,
    /// Writes the settings.
    SaveSettings,
    /// Reads the settings.
    LoadSettings,
    /// Closes the window.
    Quit,
}

const CONTENTS: [(KeyCode, Content); 8] = [
    (KeyCode::Digit1, Content::Noisy),
    (KeyCode::Digit2, Content::Filtered(Preset::Svgf)),
    (KeyCode::Digit3, Content::Filtered(Preset::Asvgf)),
    (KeyCode::Digit4, Content::Filtered(Preset::Percentile)),
    (KeyCode::Digit5, Content::Filtered(Preset::Fast)),
    (KeyCode::Digit6, Content::Filtered(Preset::Eaw)),
    (KeyCode::Digit7, Content::Filtered(Preset::Best)),
    (KeyCode::Digit8, Content::Reference),
];

const ACTIONS: [(KeyCode, bool, Action); 17] = [
    (KeyCode::Space, false, Action::Pause),
    (KeyCode::KeyN, false, Action::Step),
    (KeyCode::KeyR, false, Action::Reset),
    (KeyCode::KeyH, false, Action::Home),
    (KeyCode::KeyX, false, Action::Swap),
    (KeyCode::KeyC, false, Action::Difference),
    (KeyCode::KeyZ, false, Action::Scaling),
    (KeyCode::KeyM, false, Action::Magnifier),
    (KeyCode::KeyP, false, Action::Panel),
    (KeyCode::F1, false, Action::Help),
    (KeyCode::F2, false, Action::Screenshot),
    (KeyCode::F3, false, Action::Record),
    (KeyCode::F4, false, Action::RecordPath),
    (KeyCode::F5, false, Action::ReplayPath),
    (KeyCode::KeyS, true, Action::SaveSettings),
    (KeyCode::KeyO, true, Action::LoadSettings),
    (KeyCode::KeyQ, true, Action::Quit),
];

/// What the help says, in its order.
pub const HELP: &[(&str, &str)] = &[
    ("W A S D, E Q", "fly; Shift: faster"),
    ("drag the picture", "look around"),
    ("drag the line", "move the divider"),
    ("1 to 8", "right half: noisy, SVGF, A-SVGF, percentile, fast, EAW, best, reference"),
    ("9", "right half: error of its filter against the reference, and back"),
    ("Shift 1 to 9", "left half"),
    ("X", "change the halves"),
    ("C", "compare: the difference of the halves, and back"),
    ("Z", "the picture as large as fits, or by a whole number"),
    ("M", "magnifier: the numbers of the pixel under the mouse, and why its history was dropped"),
    ("Space", "pause"),
    ("N", "single step"),
    ("R", "drop all history"),
    ("H", "camera back to its path"),
    ("P", "panel"),
    ("F2", "write the picture as PNG"),
    ("F3", "write every frame as PNG, until F3"),
    ("F4, F5", "record the camera's way until F4, fly it"),
    ("Ctrl S, Ctrl O", "save, load the settings"),
    ("drop a .gltf or .glb", "load the scene"),
    #[cfg(feature = "hot-reload")]
    ("save a .comp or .glsl", "compile it and put it in place; the old shader stays while the new one is broken"),
    ("Ctrl Q", "close"),
];

/// What a key does when it is pressed.
pub fn action(key: KeyCode, shift: bool, ctrl: bool) -> Option<Action> {
    if let Some((_, content)) = CONTENTS.iter().find(|c| c.0 == key && !ctrl) {
        return Some(if shift { Action::Left(*content) } else { Action::Right(*content) });
    }
    if key == KeyCode::Digit9 && !ctrl {
        return Some(if shift { Action::LeftError } else { Action::RightError });
    }
    ACTIONS.iter().find(|a| a.0 == key && a.1 == ctrl).map(|a| a.2)
}

/// A key that flies, while it is held. With Ctrl it is none.
pub fn hold(held: &mut Held, key: KeyCode, is_down: bool) {
    let flag = match key {
        KeyCode::KeyW => &mut held.forward,
        KeyCode::KeyS => &mut held.back,
        KeyCode::KeyA => &mut held.left,
        KeyCode::KeyD => &mut held.right,
        KeyCode::KeyE => &mut held.up,
        KeyCode::KeyQ => &mut held.down,
        _ => return,
    };
    *flag = is_down;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_does_one_thing() {
        for (i, a) in ACTIONS.iter().enumerate() {
            assert!(ACTIONS[..i].iter().all(|b| (a.0, a.1) != (b.0, b.1)), "{a:?}");
            assert_eq!(action(a.0, false, a.1), Some(a.2));
        }
        assert_eq!(action(KeyCode::Digit1, true, false), Some(Action::Left(Content::Noisy)));
        assert_eq!(action(KeyCode::Digit9, true, false), Some(Action::LeftError));
        assert_eq!(action(KeyCode::KeyQ, false, false), None);
        let mut held = Held::default();
        hold(&mut held, KeyCode::KeyW, true);
        assert!(held.moves());
        hold(&mut held, KeyCode::KeyW, false);
        assert_eq!(held, Held::default());
    }
}
