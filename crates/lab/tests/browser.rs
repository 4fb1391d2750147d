//! The page in a browser: what the reader does, and what the page then shows. Ignored where there is no browser;
//! `ATROUS_REQUIRE_BROWSER=1` makes that a failure.

mod support;

use atrous_harness::browser::{Chromium, BROWSER};
use atrous_harness::{DeviceTest, Group};
use serde_json::{json, Value};
use std::path::Path;
use std::sync::OnceLock;

const DESKTOP: [u32; 2] = [1200, 900];
const EXTENT: [u32; 2] = [320, 180];

const TESTS: &[DeviceTest] = &[
    ("all_pictures_are_inside", all_pictures_are_inside),
    ("the_handle_divides_the_pictures", the_handle_divides_the_pictures),
    ("pictures_are_chosen", pictures_are_chosen),
    ("pixels_are_enlarged_by_whole_factors", pixels_are_enlarged_by_whole_factors),
    ("lines_are_hidden_and_read", lines_are_hidden_and_read),
    ("lines_stand_at_their_ticks", lines_stand_at_their_ticks),
    ("rows_are_sorted", rows_are_sorted),
    ("a_phone_shows_the_whole_width", a_phone_shows_the_whole_width),
];

static FOUND: OnceLock<Result<Chromium, String>> = OnceLock::new();

fn main() {
    let found = FOUND.get_or_init(|| Chromium::find(Path::new(env!("CARGO_TARGET_TMPDIR"))));
    atrous_harness::run_with(&BROWSER, &[Group { name: "", tests: TESTS, needs_device: true }], found);
}

/// What scripts of tests share.
const TOOLS: &str = "
const find = (selector) => document.querySelector(selector);
const all = (selector) => [...document.querySelectorAll(selector)];
const fire = (element, type) => element.dispatchEvent(new Event(type, { bubbles: true }));
const choose = (selector, text) => {
    const list = find(selector);
    list.value = [...list.options].find((o) => o.textContent === text).value;
    fire(list, 'change');
};
// Which picture is seen at a part of the stage's width, a fifth from its top: by the browser's own search, which heeds clipping.
const seen = (part) => {
    find('.stage').scrollIntoView();
    const box = find('.stage').getBoundingClientRect();
    return document.elementFromPoint(box.left + part * box.width, box.top + 0.2 * box.height).alt ?? 'none';
};
const strip = () => [0.02, 0.3, 0.7, 0.98].map(seen);
// A mouse or a finger that no browser sent cannot be captured.
Element.prototype.setPointerCapture = () => {};
const point = (element, type, part, pointerType = 'mouse') => {
    const box = find('.stage').getBoundingClientRect();
    const place = { clientX: box.left + part * box.width, clientY: box.top + 5, bubbles: true, cancelable: true };
    element.dispatchEvent(new PointerEvent(type, { ...place, pointerType, pointerId: 1, isPrimary: true, button: 0 }));
};
";

fn observe_at(extent: [u32; 2], script: &str) -> Value {
    let Some(Ok(browser)) = FOUND.get() else { panic!("no browser") };
    browser.observe(&support::sample(EXTENT[0], EXTENT[1]).html(), extent, &format!("{TOOLS}{script}"))
}

fn observe(script: &str) -> Value {
    observe_at(DESKTOP, script)
}

fn all_pictures_are_inside() {
    let seen = observe(
        "const layers = all('.layer');
        const first = (layer) => {
            const canvas = document.createElement('canvas').getContext('2d');
            canvas.drawImage(layer, 0, 0);
            return [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3);
        };
        const loaded = performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !n.startsWith('data:'));
        return { layers: layers.map((l) => [l.alt, l.naturalWidth, l.naturalHeight]), first: layers.slice(0, 3).map(first), loaded };",
    );
    let names = support::FIRST_PIXELS.map(|(name, _)| name).into_iter().chain(["error of svgf"]);
    let layers: Vec<_> = names.map(|name| json!([name, EXTENT[0], EXTENT[1]])).collect();
    assert_eq!(seen["layers"], json!(layers));
    assert_eq!(seen["first"], json!(support::FIRST_PIXELS.map(|(_, pixel)| pixel)));
    assert_eq!(seen["loaded"], json!([]), "nothing else is loaded");
}

fn the_handle_divides_the_pictures() {
    let seen = observe(
        "const start = strip();
        const split = find('.split'), stage = find('.stage'), handle = find('.handle');
        split.value = 85; fire(split, 'input');
        const keys = strip();
        point(stage, 'pointerdown', 0.5);
        point(stage, 'pointermove', 0.1);
        const dragged = strip();
        point(stage, 'pointermove', -0.5);
        const beyond = split.value;
        point(stage, 'pointermove', 0.11);
        point(stage, 'pointerup', 0.11);
        point(stage, 'pointermove', 0.9);
        const released = Number(split.value);
        point(stage, 'pointerdown', 0.9, 'touch');
        const beside = Number(split.value);
        point(stage, 'click', 0.6, 'touch');
        const tapped = Number(split.value);
        point(handle, 'pointerdown', 0.6, 'touch');
        point(handle, 'pointermove', 0.805, 'touch');
        const exact = parseFloat(stage.style.getPropertyValue('--split')).toFixed(3);
        return { start, keys, dragged, beyond, released, beside, tapped, exact, focused: document.activeElement === split };",
    );
    assert_eq!(seen["start"], json!(["noisy", "noisy", "reference", "reference"]));
    assert_eq!(seen["keys"], json!(["noisy", "noisy", "noisy", "reference"]));
    assert_eq!(seen["dragged"], json!(["noisy", "reference", "reference", "reference"]));
    assert_eq!(seen["beyond"], "0", "the handle stays on the picture");
    assert_eq!(seen["released"], 11, "it no longer follows");
    assert_eq!(seen["beside"], 11, "a finger beside the handle scrolls");
    assert_eq!(seen["tapped"], 60, "and a tap moves the handle");
    assert_eq!(seen["exact"], "80.500", "the pointer is not held to the steps of the keys");
    assert_eq!(seen["focused"], true, "arrow keys go on from there");
}

fn pictures_are_chosen() {
    let seen = observe(
        "const state = () => ({ strip: strip(), tags: all('.tag').map((t) => t.textContent), bars: all('.colour-bar').filter((b) => b.offsetHeight > 0).map((b) => b.textContent) });
        const start = state();
        choose('.choose-left', 'svgf');
        choose('.choose-right', 'error of svgf');
        const error = state();
        choose('.choose-right', 'svgf');
        return { start, error, same: state() };",
    );
    assert_eq!(seen["start"]["tags"], json!(["noisy", "reference"]));
    assert_eq!(seen["start"]["bars"], json!([]));
    assert_eq!(seen["error"]["strip"], json!(["svgf", "svgf", "error of svgf", "error of svgf"]));
    assert_eq!(seen["error"]["tags"], json!(["svgf", "error of svgf"]));
    assert_eq!(seen["error"]["bars"], json!(["error of svgf00.5"]), "name, lowest and highest value");
    assert_eq!(seen["same"]["strip"], json!(vec!["svgf"; 4]), "one picture on both sides is whole");
    assert_eq!(seen["same"]["bars"], json!([]));
}

fn pixels_are_enlarged_by_whole_factors() {
    let seen = observe(
        "const stage = find('.stage'), viewport = find('.viewport');
        viewport.style.width = '400px';
        const split = find('.split');
        split.value = 75; fire(split, 'input');
        const look = () => [stage.offsetWidth, stage.offsetHeight, getComputedStyle(find('.layer.left')).imageRendering];
        const zooms = {};
        for (const zoom of ['4×', '3×', '2×', '1×', 'Fit']) {
            choose('.zoom', zoom);
            zooms[zoom] = look();
            if (zoom === '4×') zooms.handle = find('.handle').getBoundingClientRect().left + 22 - viewport.getBoundingClientRect().left;
        }
        viewport.style.width = '160px';
        zooms.narrow = look();
        return zooms;",
    );
    for factor in 1..=4 {
        let expected = json!([factor * EXTENT[0], factor * EXTENT[1], "pixelated"]);
        assert_eq!(seen[format!("{factor}×")], expected);
    }
    assert_eq!(seen["Fit"], json!([320, 180, "auto"]), "never more than its own size");
    assert_eq!(seen["narrow"], json!([160, 90, "auto"]));
    let handle = seen["handle"].as_f64().unwrap();
    assert!((handle - 200.0).abs() < 2.0, "the handle stays in the middle of what is seen: {handle}");
}

fn lines_are_hidden_and_read() {
    let seen = observe(
        "const plot = find('.plot'), legend = all('.legend button');
        const shown = () => all('g.series').map((g) => getComputedStyle(g).display !== 'none');
        const read = () => [find('.across').textContent, ...all('.legend .value').map((v) => v.textContent)];
        const box = plot.getBoundingClientRect();
        const hover = (frame) => plot.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + (box.width * frame) / 63, clientY: box.top + 5 }));
        const result = { start: shown() };
        legend[1].click();
        result.hidden = shown();
        result.pressed = legend.map((b) => b.getAttribute('aria-pressed'));
        legend[1].click();
        result.again = shown();
        hover(0);
        result.first = read();
        hover(20.4);
        result.gap = read();
        const cursor = find('.cursor').getBoundingClientRect();
        result.cursor = ((cursor.left - box.left) / box.width) * 63;
        plot.dispatchEvent(new PointerEvent('pointerleave'));
        result.left = read();
        const key = (name) => plot.dispatchEvent(new KeyboardEvent('keydown', { key: name }));
        key('ArrowLeft'); key('ArrowLeft'); key('ArrowRight'); key('ArrowRight');
        result.keys = read();
        return result;",
    );
    assert_eq!(seen["start"], json!(vec![true; 3]));
    assert_eq!(seen["hidden"], json!([true, false, true]));
    assert_eq!(seen["pressed"], json!(["true", "false", "true"]));
    assert_eq!(seen["again"], json!(vec![true; 3]));
    assert_eq!(seen["first"], json!(["frame 1000", "27.5", "22", "10"]));
    assert_eq!(seen["gap"], json!(["frame 1020", "7.222", "–", "10"]));
    assert!((seen["cursor"].as_f64().unwrap() - 20.0).abs() < 0.1, "{}", seen["cursor"]);
    assert_eq!(seen["left"], json!(["frame", "", "", ""]));
    assert_eq!(seen["keys"][0], "frame 1063");
}

fn lines_stand_at_their_ticks() {
    let seen = observe(
        "const middle = (element, side, length) => { const box = element.getBoundingClientRect(); return box[side] + box[length] / 2; };
        const tick = (axis, text) => all(axis + ' span').find((s) => s.textContent === text);
        const budget = all('g.series')[2].querySelector('.line');
        const dots = all('g.series')[1].querySelector('.dots').getBoundingClientRect();
        return {
            up: middle(budget, 'top', 'height') - middle(tick('.rows', '10'), 'top', 'height'),
            along: middle(tick('.columns', '1030'), 'left', 'width') - dots.left,
            frame: find('.plot').getBoundingClientRect().width / 63,
        };",
    );
    let number = |name: &str| seen[name].as_f64().unwrap();
    assert!(number("up").abs() < 0.5, "the line of 10 ms stands beside the label 10: {seen}");
    // The dot is frame 31 of those from 1000 on: one to the right of the label.
    assert!((number("along") + number("frame")).abs() < 0.5, "{seen}");
}

fn rows_are_sorted() {
    let seen = observe(
        "const table = find('table');
        const names = () => [...table.tBodies[0].rows].map((r) => r.cells[0].textContent);
        const click = (column) => { table.tHead.rows[0].cells[column].querySelector('button').click(); return names(); };
        const order = () => [...table.tHead.rows[0].cells].map((c) => c.getAttribute('aria-sort'));
        return { start: names(), rmse: click(1), turned: click(1), ms: click(3), ms_turned: click(3), psnr: click(2), order: order(), psnr_turned: click(2), name: click(0) };",
    );
    assert_eq!(seen["start"], json!(["noisy", "svgf", "eaw", "reference"]));
    assert_eq!(seen["rmse"], json!(["reference", "svgf", "eaw", "noisy"]), "the best first");
    assert_eq!(seen["turned"], json!(["noisy", "eaw", "svgf", "reference"]));
    assert_eq!(seen["psnr"], json!(["reference", "svgf", "eaw", "noisy"]), "the best first, and infinity is the best");
    assert_eq!(seen["psnr_turned"], json!(["noisy", "eaw", "svgf", "reference"]));
    assert_eq!(seen["order"], json!([null, null, "descending", null]));
    assert_eq!(seen["ms"], json!(["eaw", "svgf", "reference", "noisy"]), "as numbers, and what was not measured last");
    assert_eq!(seen["ms_turned"], json!(["reference", "svgf", "eaw", "noisy"]));
    assert_eq!(seen["name"], json!(["eaw", "noisy", "reference", "svgf"]));
}

fn a_phone_shows_the_whole_width() {
    let seen = observe_at([320, 640], "return [innerWidth, document.scrollingElement.scrollWidth];");
    assert_eq!(seen[0], 320);
    assert_eq!(seen[1], 320, "the page does not scroll sideways");
}
