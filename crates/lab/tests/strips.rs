//! Strips: sizes, labels that stay above their panel, insets.

use atrous_lab::pictures::{Picture, PictureError, Region, Strip};

const GAP: u32 = 8;
const PANEL: [u8; 3] = [0, 0, 200];

fn panel(width: u32, height: u32) -> Picture {
    Picture::filled(width, height, PANEL).unwrap()
}

/// Bounding box (left, top, right, bottom; inclusive) of the pixels that differ from the background.
fn drawn(picture: &Picture) -> [u32; 4] {
    let background = picture.pixel(0, 0).unwrap();
    let mut bounds = [u32::MAX, u32::MAX, 0, 0];
    for y in 0..picture.height() {
        for x in (0..picture.width()).filter(|&x| picture.pixel(x, y) != Some(background)) {
            bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
        }
    }
    bounds
}

#[test]
fn sizes() {
    let bare = Strip::new("").panel("", panel(100, 50)).panel("", panel(100, 50));
    let strip = bare.render().unwrap();
    assert_eq!([strip.width(), strip.height()], [3 * GAP + 200, 2 * GAP + 50]);
    let large = bare.clone().upscale(3).render().unwrap();
    assert_eq!([large.width(), large.height()], [3 * GAP + 600, 2 * GAP + 150]);
    let grid = bare.clone().panel("", panel(100, 50)).columns(2).render().unwrap();
    assert_eq!([grid.width(), grid.height()], [3 * GAP + 200, 3 * GAP + 100]);
    let inset = bare.clone().inset(Region { x: 10, y: 10, width: 25, height: 10 }).render().unwrap();
    assert_eq!([inset.width(), inset.height()], [3 * GAP + 200, 3 * GAP + 50 + 40]);
    let labelled = Strip::new("title").panel("one\ntwo", panel(100, 50)).render().unwrap();
    assert!(labelled.height() > 2 * GAP + 50 && labelled.width() == 2 * GAP + 100);
    assert_eq!(labelled.pixel(GAP + 50, labelled.height() - GAP - 1), Some(PANEL));
}

#[test]
fn labels_stay_above_their_panel() {
    let long = "a label far longer than any panel that it could ever stand above, with an à-trous in it".repeat(3);
    for width in [12, 40, 100, 320, 1000] {
        let strip = Strip::new(long.as_str()).panel(format!("{long}\n{long}"), panel(width, 30)).panel("", panel(width, 30));
        let strip = strip.render().unwrap();
        let [left, top, right, bottom] = drawn(&strip);
        assert!(left >= GAP && top >= GAP, "{width}");
        assert!(right < strip.width() - GAP && bottom < strip.height() - GAP, "{width}");
        // Below the title, nothing is drawn between the panels nor above the second one, which has no label.
        let first_row = (0..strip.height()).find(|&y| strip.pixel(GAP, y) == Some(PANEL)).unwrap();
        let beyond = GAP + width..strip.width();
        // Two lines of at least eight pixels.
        let labels = first_row - 16..first_row;
        assert!(labels.clone().all(|y| beyond.clone().all(|x| strip.pixel(x, y) == strip.pixel(0, 0))), "{width}");
        let written = labels.clone().any(|y| (GAP..GAP + width).any(|x| strip.pixel(x, y) != strip.pixel(0, 0)));
        assert!(written, "{width}");
    }
}

#[test]
fn an_inset_enlarges_its_region() {
    let mut picture = panel(64, 32);
    picture.paste(&Picture::filled(8, 4, [250, 120, 10]).unwrap(), 16, 8);
    let region = Region { x: 16, y: 8, width: 8, height: 4 };
    let strip = Strip::new("").panel("", picture).inset(region).render().unwrap();
    let inset_top = 2 * GAP + 32;
    // Within an outline of two pixels, the inset shows the region and nothing else.
    let inside = (2..62).all(|x| (2..30).all(|y| strip.pixel(GAP + x, inset_top + y) == Some([250, 120, 10])));
    assert!(inside);
    // The outline in the panel lies around the region.
    assert_eq!(strip.pixel(GAP + 16, GAP + 8), Some([250, 120, 10]));
    assert_ne!(strip.pixel(GAP + 15, GAP + 7), Some(PANEL));
}

#[test]
fn wrong_input_is_an_error() {
    assert!(matches!(Strip::new("nothing").render(), Err(PictureError::NoPanel)));
    let one = Strip::new("").panel("a", panel(10, 10));
    let mixed = one.clone().panel("b", panel(10, 11)).render().unwrap_err();
    assert!(mixed.to_string().contains("\"b\" is 10x11 pixels"), "{mixed}");
    assert!(matches!(one.clone().columns(0).render(), Err(PictureError::Zero(_))));
    assert!(matches!(one.clone().upscale(0).render(), Err(PictureError::Zero(_))));
    assert!(matches!(one.clone().upscale(1_000_000).render(), Err(PictureError::TooLarge { .. })));
    for region in [Region { x: 5, y: 5, width: 6, height: 1 }, Region { x: 0, y: 0, width: 1, height: 0 }] {
        assert!(matches!(one.clone().inset(region).render(), Err(PictureError::Region { .. })));
    }
}
