//! Statistics of all shaders: as a file, and as a table of Markdown that can be read back.

use atrous_lab::pictures::{Column, PictureError, TextTable};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Statistics that the table shows where the driver has them, in this order; the file has all.
const SHOWN: [&str; 7] = [VGPRS, "SGPRs", "Subgroups per SIMD", "Instructions", "Latency", INVERSE_THROUGHPUT, "Code size"];
/// Vector registers of an invocation.
pub const VGPRS: &str = "VGPRs";
/// Cycles that a wave keeps the device busy.
pub const INVERSE_THROUGHPUT: &str = "Inverse Throughput";
/// Column of the loops that are left.
const LOOPS: &str = "Loops";
/// Lines around the table in a Markdown file.
const MARKERS: [&str; 2] = ["<!-- bench --isa: begin -->", "<!-- bench --isa: end -->"];

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IsaReport {
    pub device: String,
    /// With its version: another one compiles otherwise.
    pub driver: String,
    pub shaders: Vec<Shader>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shader {
    /// Module and specialisation constants.
    pub name: String,
    /// Loops that the compiler left. A driver's estimate of cycles weights them by a constant, so it holds without loops alone.
    pub loops: u32,
    pub statistics: BTreeMap<String, f64>,
}

impl IsaReport {
    pub fn find(&self, name: &str) -> Option<&Shader> {
        self.shaders.iter().find(|shader| shader.name == name)
    }

    /// Device and driver in a line, then a table.
    pub fn to_markdown(&self) -> Result<String, PictureError> {
        let has = |name: &str| self.shaders.iter().any(|s| s.statistics.contains_key(name));
        let mut names: Vec<&str> = SHOWN.into_iter().filter(|name| has(name)).collect();
        if names.is_empty() {
            let all: std::collections::BTreeSet<_> = self.shaders.iter().flat_map(|s| s.statistics.keys()).collect();
            names = all.into_iter().map(String::as_str).collect();
        }
        let columns = names.iter().copied().chain([LOOPS]).map(|name| Column::new(name, 0));
        let mut table = TextTable::new("shader", columns);
        for shader in &self.shaders {
            let statistics = names.iter().map(|name| shader.statistics.get(*name).copied().unwrap_or(f64::NAN));
            let values: Vec<f64> = statistics.chain([f64::from(shader.loops)]).collect();
            table.row(&shader.name, &values)?;
        }
        Ok(format!("Device: {}; driver: {}\n\n{table}", self.device, self.driver))
    }

    /// Reads what [`Self::to_markdown`] wrote, from between the markers of a file.
    pub fn from_markdown(text: &str) -> Result<Self, String> {
        let (_, inside, _) = split(text)?;
        let mut lines = inside.lines().map(str::trim).filter(|line| !line.is_empty());
        let heading = lines.next().and_then(|line| line.strip_prefix("Device: ")?.split_once("; driver: "));
        let (device, driver) = heading.ok_or("no line `Device: ...; driver: ...` stands before the table")?;
        let mut rows = lines.map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
        let names = rows.next().ok_or("there is no table")?;
        let rule = |row: &Vec<&str>| row.iter().all(|cell| cell.chars().all(|c| "-:".contains(c)) && cell.len() > 2);
        let shader = |row: Vec<&str>| {
            let numbers = names.iter().zip(&row).skip(1).filter_map(|(name, cell)| Some(((*name).to_owned(), cell.parse().ok()?)));
            let mut statistics: BTreeMap<String, f64> = numbers.collect();
            let loops = statistics.remove(LOOPS).unwrap_or(0.0) as u32;
            Shader { name: row.first().copied().unwrap_or_default().to_owned(), loops, statistics }
        };
        let shaders = rows.filter(|row| !rule(row)).map(shader).collect();
        Ok(Self { device: device.to_owned(), driver: driver.to_owned(), shaders })
    }

    /// The text of a file with this report in place of the one between its markers.
    pub fn written_into(&self, text: &str) -> Result<String, Box<dyn std::error::Error>> {
        let (before, _, after) = split(text)?;
        Ok(format!("{before}{}\n\n{}\n{}{after}", MARKERS[0], self.to_markdown()?, MARKERS[1]))
    }
}

/// What stands before, between and behind the markers.
fn split(text: &str) -> Result<(&str, &str, &str), String> {
    let missing = || format!("the lines `{}` and `{}` are missing; the table stands between them", MARKERS[0], MARKERS[1]);
    let (before, rest) = text.split_once(MARKERS[0]).ok_or_else(missing)?;
    let (inside, after) = rest.split_once(MARKERS[1]).ok_or_else(missing)?;
    Ok((before, inside, after))
}
