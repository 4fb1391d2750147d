//! What the colours and numbers of a half stand for: on the window and in pictures that are written.

use atrous::nodes::Ramp;
use atrous::DebugView;
use atrous_lab::pages::HeatMap;
use atrous_lab::pictures::{srgb_8bit, ColourBar, Legend};

use super::content::Content;
use super::shared::ErrorReport;

/// Colours of a bar.
const STEPS: u32 = 64;

/// The legend of what is shown. `paths`: of each pixel in the reference now. Empty where a picture is a picture.
pub fn of_content(content: Content, paths: u32, errors: &[ErrorReport]) -> Legend {
    match content {
        Content::Noisy | Content::Filtered(_) => Legend::default(),
        Content::Reference => Legend { title: paths_a_pixel(paths), ..Legend::default() },
        Content::Error(preset) => {
            let measured = errors.iter().find(|error| error.preset == preset);
            let title = measured.map_or_else(|| "being measured".to_owned(), numbers);
            Legend { title, bars: vec![flip()], ..Legend::default() }
        }
        Content::Debug(_, view) => of_view(view),
    }
}

/// The legend of the difference of two halves that ends at `range`.
pub fn of_difference(range: f32) -> Legend {
    let colours = (0..=STEPS).map(|i| [(255 * i / STEPS) as u8; 3]).collect();
    let mark = |place: f32, share: f32| (place, format!("{:+.0} %", 100.0 * share));
    let marks = vec![mark(0.0, -range), (0.5, "0".to_owned()), mark(1.0, range)];
    let name = "share of white, as it is encoded".to_owned();
    Legend { bars: vec![ColourBar { name, colours, marks }], ..Legend::default() }
}

/// The same with a first line that says what it is of; an empty one stays empty.
pub fn titled(legend: &Legend, title: &str) -> Legend {
    if legend.is_empty() {
        return Legend::default();
    }
    let title = if legend.title.is_empty() { title.to_owned() } else { format!("{title}: {}", legend.title) };
    Legend { title, ..legend.clone() }
}

fn paths_a_pixel(paths: u32) -> String {
    format!("{paths} path{} a pixel", if paths == 1 { "" } else { "s" })
}

fn numbers(error: &ErrorReport) -> String {
    format!("RMSE {:.4}, FLIP {:.4} against {}", error.rmse, error.flip, paths_a_pixel(error.paths))
}

fn flip() -> ColourBar {
    let end = HeatMap::LARGEST_FLIP;
    let values: Vec<f32> = (0..=STEPS).map(|i| end * i as f32 / STEPS as f32).collect();
    let colours = HeatMap::of_flip(STEPS + 1, 1, &values).map(|map| map.picture().pixels().to_vec()).unwrap_or_default();
    let marks = vec![(0.0, "0".to_owned()), (0.5, format!("{}", 0.5 * end)), (1.0, format!("{end}+"))];
    ColourBar { name: "FLIP".to_owned(), colours, marks }
}

fn of_view(view: DebugView) -> Legend {
    let legend = view.legend();
    let swatches = legend.cases.iter().map(|(name, colour)| (*colour, (*name).to_owned())).collect();
    Legend { title: legend.note.to_owned(), bars: legend.ramps.iter().map(bar).collect(), swatches }
}

fn bar(ramp: &Ramp) -> ColourBar {
    let colours = (0..=STEPS).map(|i| ramp.colour(i as f32 / STEPS as f32).map(srgb_8bit)).collect();
    let marks = ramp.marks.iter().map(|(place, text)| (*place, (*text).to_owned())).collect();
    ColourBar { name: ramp.name.to_owned(), colours, marks }
}

#[cfg(test)]
mod tests {
    use super::*;
    use atrous::config::Preset;

    #[test]
    fn every_debug_view_has_a_legend_and_a_picture_has_none() {
        for view in DebugView::ALL {
            let legend = of_content(Content::Debug(Preset::Svgf, view), 0, &[]);
            assert!(!legend.is_empty(), "{view:?}");
            assert_eq!(legend.bars.len(), view.legend().ramps.len());
        }
        for content in [Content::Noisy, Content::Filtered(Preset::Svgf)] {
            assert!(titled(&of_content(content, 9, &[]), "picture").is_empty());
        }
    }

    #[test]
    fn the_reference_says_its_paths_and_an_error_its_numbers() {
        let title = |paths| titled(&of_content(Content::Reference, paths, &[]), "reference").title;
        assert_eq!([title(1), title(512)], ["reference: 1 path a pixel", "reference: 512 paths a pixel"]);
        let of = |preset, rmse| ErrorReport { preset, rmse, flip: 0.05, paths: 7 };
        let errors = [of(Preset::Svgf, 0.5), of(Preset::Asvgf, 0.25)];
        let shown = of_content(Content::Error(Preset::Asvgf), 9, &errors);
        assert_eq!(shown.title, "RMSE 0.2500, FLIP 0.0500 against 7 paths a pixel");
        assert_eq!(shown.bars[0].marks.last().map(|mark| mark.1.as_str()), Some("0.5+"));
        assert!(of_content(Content::Error(Preset::Eaw), 9, &errors).title.contains("being"));
    }

    #[test]
    fn a_difference_has_its_range() {
        let legend = of_difference(0.1);
        let marks: Vec<_> = legend.bars[0].marks.iter().map(|mark| mark.1.as_str()).collect();
        assert_eq!(marks, ["-10 %", "0", "+10 %"]);
        assert_eq!([0.0, 1.0].map(|place| legend.bars[0].colour(place)), [[0; 3], [255; 3]]);
    }
}
