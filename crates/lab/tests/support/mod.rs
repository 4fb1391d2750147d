//! A page with something of everything.

use atrous_lab::pages::{Best, Cell, Comparison, Curves, HeatMap, Page, Table};
use atrous_lab::pictures::{Column, Picture, TextTable};

/// The value of the first pixel of each picture of [`sample`], red, green and blue.
pub const FIRST_PIXELS: [(&str, [u8; 3]); 3] = [("noisy", [255, 0, 0]), ("svgf", [0, 200, 0]), ("reference", [0, 0, 255])];

/// Two sections: a comparison of three pictures and an error of `width` x `height` pixels; a table and curves.
pub fn sample(width: u32, height: u32) -> Page {
    let mut page = Page::new("Cornell box, 1 sample per pixel");
    page.introduction("What the presets make of the same 64 frames. Drag the handle of a picture to compare.");
    let section = page.section("Last frame");
    section.text("The noisy frame against the reference, which has 4096 samples per pixel.");
    let mut comparison = Comparison::new("Frame 63");
    for (i, (name, first)) in FIRST_PIXELS.into_iter().enumerate() {
        comparison.picture(name, &picture(width, height, [60, 12, 0][i], first)).unwrap();
    }
    let errors: Vec<_> = (0..width * height).map(|i| noise(i) * (i % width) as f32 / width as f32).collect();
    let map = HeatMap::new(width, height, &errors, 0.0..=0.5).unwrap();
    comparison.heat_map("error of svgf", &map).unwrap();
    section.comparison(comparison).unwrap();

    let section = page.section("Presets");
    let mut numbers = TextTable::new("preset", [Column::new("RMSE", 4), Column::new("PSNR, dB", 1), Column::new("ms", 2)]);
    numbers.row("noisy", &[0.1234, 18.2, f64::NAN]).unwrap();
    numbers.row("svgf", &[0.0213, 33.4, 10.25]).unwrap();
    numbers.row("eaw", &[0.0305, 30.3, 9.5]).unwrap();
    numbers.row("reference", &[0.0, f64::INFINITY, 100.0]).unwrap();
    let mut table = Table::from(&numbers);
    table.best("RMSE", Best::Lowest).unwrap();
    table.best("PSNR, dB", Best::Highest).unwrap();
    section.table(table);
    let curve = |start: f64| (0..64).map(move |i| start * (0.1 + (-f64::from(i) / 12.0).exp())).collect::<Vec<_>>();
    let mut gap = curve(20.0);
    gap[20..24].fill(f64::NAN);
    gap[30] = f64::NAN;
    gap[32] = f64::NAN;
    let curves = Curves::new("Time of a frame").unit("ms").first_frame(1000);
    let curves = curves.series("svgf", curve(25.0)).series("eaw", gap).series("budget", vec![10.0; 64]);
    section.curves(curves).unwrap();
    let mut settings = Table::new("setting", ["value", "default"]);
    settings.row("iterations", [Cell::number(5.0, "5"), "4".into()]).unwrap();
    settings.row("phi of the normal", ["128", "128"]).unwrap();
    section.table(settings);
    page
}

fn picture(width: u32, height: u32, grain: u32, first: [u8; 3]) -> Picture {
    let pixel = |i: u32| {
        let (x, y) = (i % width, i / width);
        let disc = (x as f32 / width as f32 - 0.5).hypot((y as f32 / height as f32 - 0.5) * 0.6) < 0.2;
        let base = if disc { [200.0, 140.0, 90.0] } else { [70.0, 90.0 + 80.0 * y as f32 / height as f32, 130.0] };
        let shift = (noise(i) - 0.5) * 2.0 * grain as f32;
        base.map(|c| (c + shift).clamp(0.0, 255.0) as u8)
    };
    let mut pixels: Vec<_> = (0..width * height).map(pixel).collect();
    pixels[0] = first;
    Picture::from_pixels(width, height, pixels).unwrap()
}

/// A number from 0 to 1 that looks random.
fn noise(i: u32) -> f32 {
    let mut x = i.wrapping_mul(0x9E37_79B9) ^ 0x5bd1_e995;
    x = (x ^ (x >> 15)).wrapping_mul(0x85EB_CA6B);
    ((x ^ (x >> 13)) & 0xffff) as f32 / 65535.0
}
