//! What is in a page, how names are escaped, and what is refused.

use crate::support;

use atrous_lab::pages::{Best, Cell, Comparison, Curves, HeatMap, Page, PageError, Table};
use atrous_lab::pictures::Picture;

/// What would end an attribute, an element or an entity if it were not escaped.
const HOSTILE: &str = r#"<script>alert("1")</script>&'a"b"#;

fn grey(width: u32, height: u32) -> Picture {
    Picture::filled(width, height, [128; 3]).unwrap()
}

#[test]
fn a_page_needs_nothing_beside_it() {
    let html = support::sample(32, 18).html();
    for outside in ["http:", "https:", "src=\"/", "@import", "url("] {
        assert!(!html.contains(outside), "{outside}");
    }
    let sources: Vec<_> = html.split(" src=\"").skip(1).collect();
    assert_eq!(sources.len(), 4);
    assert!(sources.iter().all(|s| s.starts_with("data:image/png;base64,iVBOR")));
    assert_eq!(html, support::sample(32, 18).html(), "the same input gives the same bytes");
}

#[test]
fn contents_lead_to_sections() {
    let mut page = Page::new("Report");
    page.section("Cornell box");
    assert!(!page.html().contains("<nav"), "one section needs no contents");
    page.section("Cornell box").text("Under the second.");
    let html = page.html();
    for anchor in ["cornell-box", "cornell-box-2"] {
        assert!(html.contains(&format!(r##"<li><a href="#{anchor}">Cornell box</a></li>"##)));
        assert!(html.contains(&format!(r#"<section id="{anchor}">"#)));
    }
    assert!(html.find("cornell-box-2\">").unwrap() < html.find("<p>Under the second.</p>").unwrap());
}

#[test]
fn names_are_escaped_everywhere() {
    let mut page = Page::new(HOSTILE);
    page.introduction(HOSTILE);
    page.section("Other");
    let section = page.section(HOSTILE);
    section.text(HOSTILE);
    let mut table = Table::new(HOSTILE, [HOSTILE, "n"]);
    table.row(HOSTILE, [Cell::from(HOSTILE), Cell::number(1.0, HOSTILE)]).unwrap();
    section.table(table);
    let mut comparison = Comparison::new(HOSTILE);
    comparison.picture(HOSTILE, &grey(2, 2)).unwrap();
    comparison.heat_map(format!("error of {HOSTILE}"), &HeatMap::new(2, 2, &[0.5; 4], 0.0..=1.0).unwrap()).unwrap();
    section.comparison(comparison).unwrap();
    section.curves(Curves::new(HOSTILE).unit(HOSTILE).series(HOSTILE, [1.0, 2.0])).unwrap();
    let html = page.html();
    assert!(!html.contains("<script>alert"), "an element");
    // Quotes end an attribute; in text they do no harm, but are escaped all the same.
    assert!(!html.contains(r#"alert("1")"#) && !html.contains("a\"b"), "a quote");
    assert!(!html.contains("&'a"), "an entity");
    let escaped = "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;'a&quot;b";
    // Title twice, introduction, contents, heading, text; 5 of the table; the comparison's caption twice and each layer in
    // 2 choices, its picture, its tag, its colour bar; the curves' title twice, unit and name.
    assert_eq!(html.matches(escaped).count(), 6 + 5 + 2 + 4 + 5 + 4);
}

#[test]
fn pictures_of_different_size_are_refused() {
    let mut comparison = Comparison::new("c");
    comparison.picture("noisy", &grey(64, 36)).unwrap();
    let message = comparison.picture("svgf", &grey(32, 36)).unwrap_err().to_string();
    for part in ["\"svgf\"", "32x36", "64x36"] {
        assert!(message.contains(part), "{message}");
    }
    let map = HeatMap::new(2, 1, &[0.0; 2], 0.0..=1.0).unwrap();
    assert!(matches!(comparison.heat_map("error", &map), Err(PageError::PictureSize { .. })));
    assert!(matches!(comparison.picture("noisy", &grey(64, 36)), Err(PageError::SameName(_))));
    assert!(matches!(comparison.start("noisy", "svgf"), Err(PageError::NoPicture(name)) if name == "svgf"));
    let refused = Page::new("p").section("s").comparison(comparison).unwrap_err();
    assert_eq!(refused.to_string(), "comparison \"c\" has 1 pictures, but at least 2 are needed");
}

#[test]
fn first_and_last_picture_are_shown_unless_others_are_chosen() {
    let shown = |html: &str, side: &str| {
        let tag = html.split(&format!("tag of-{side}\">")).nth(1).unwrap();
        tag[..tag.find('<').unwrap()].to_owned()
    };
    let html = support::sample(8, 8).html();
    assert_eq!([shown(&html, "left"), shown(&html, "right")], ["noisy", "reference"]);
    let mut comparison = Comparison::new("c");
    let map = HeatMap::new(2, 1, &[0.0; 2], 0.0..=1.0).unwrap();
    comparison.picture("a", &grey(2, 1)).unwrap();
    comparison.heat_map("error", &map).unwrap();
    let mut page = Page::new("p");
    page.section("s").comparison(comparison.clone()).unwrap();
    assert_eq!(shown(&page.html(), "right"), "error", "a heat map, where there is but one picture");
    comparison.start("error", "a").unwrap();
    let mut page = Page::new("p");
    page.section("s").comparison(comparison).unwrap();
    assert_eq!([shown(&page.html(), "left"), shown(&page.html(), "right")], ["error", "a"]);
}

#[test]
fn curves_without_values_are_refused() {
    let mut page = Page::new("p");
    let section = page.section("s");
    for curves in
        [Curves::new("time"), Curves::new("time").series("a", []), Curves::new("time").series("a", [f64::NAN, f64::INFINITY])]
    {
        assert_eq!(section.curves(curves).unwrap_err().to_string(), "curves \"time\" have no finite value to draw");
    }
}

#[test]
fn values_that_are_not_finite_are_gaps() {
    let mut page = Page::new("p");
    let nan = f64::NAN;
    page.section("s").curves(Curves::new("c").series("a", [0.0, 1.0, nan, 0.5, nan, f64::INFINITY, 0.0, 0.25])).unwrap();
    let html = page.html();
    let path = |class: &str| {
        let path = html.split(&format!("<path class=\"{class}\" d=\"")).nth(1).unwrap();
        path[..path.find('"').unwrap()].to_owned()
    };
    // Two lines with a dot between them; the axis ends at 1.06.
    assert_eq!(path("line"), "M0.0 1000.0L142.9 56.6M857.1 1000.0L1000.0 764.2");
    assert_eq!(path("dots"), "M428.6 528.3h0");
    assert!(html.contains("data-values=\"0.0000e0,1.0000e0,,5.0000e-1,,,0.0000e0,2.5000e-1\""));
}

#[test]
fn one_frame_has_a_place() {
    let mut page = Page::new("p");
    page.section("s").curves(Curves::new("c").series("a", [2.0])).unwrap();
    let html = page.html();
    assert!(html.contains("d=\"M500.0 "), "the dot stands in the middle");
    assert!(html.contains("<span style=\"left:50.00%\">0</span>"), "and the number of its frame");
}

#[test]
fn the_best_of_a_column_is_bold() {
    let mut table = Table::new("preset", ["RMSE", "PSNR", "note"]);
    for (name, rmse, psnr) in [("a", 0.02004, 30.0), ("b", f64::NAN, f64::NAN), ("c", 0.01996, 35.0), ("d", 0.5, f64::INFINITY)] {
        table.row(name, [Cell::number(rmse, format!("{rmse:.3}")), Cell::number(psnr, psnr.to_string()), "0.020".into()]).unwrap();
    }
    table.best("RMSE", Best::Lowest).unwrap();
    table.best("PSNR", Best::Highest).unwrap();
    table.best("note", Best::Lowest).unwrap();
    let mut page = Page::new("p");
    page.section("s").table(table.clone());
    let html = page.html();
    let bold: Vec<_> = html.split("<strong>").skip(1).map(|s| &s[..s.find('<').unwrap()]).collect();
    assert_eq!(bold, ["0.020", "0.020", "inf"], "both that read 0.020, and no word");
    assert!(matches!(table.best("SSIM", Best::Highest), Err(PageError::NoColumn(name)) if name == "SSIM"));
    let message = table.row("e", ["1"]).unwrap_err().to_string();
    assert_eq!(message, "row \"e\" has 1 cells, but the table has 3 columns beside the names of rows");
}

#[test]
fn the_file_is_the_page_or_as_it_was() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let path = folder.path().join("report.html");
    let (first, second) = (Page::new("first"), Page::new("second"));
    first.write(&path).unwrap();
    second.write(&path).unwrap();
    assert!(matches!(first.write_new(&path), Err(PageError::File { .. })));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), second.html());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    let message = first.write(folder.path().join("missing/report.html")).unwrap_err().to_string();
    assert!(message.contains("missing/report.html"), "{message}");
}
