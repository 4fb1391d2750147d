//! The map from the channels of a file to their roles.

use crate::error::{Result, ToolError};
use crate::exr_header::{Channel, ExrHeader};
use crate::layouts::{recognise, Entry, Layout, ENTRIES};
use crate::roles::{Kind, Role};
use exr::meta::attribute::{AttributeValue, SampleType};
use std::collections::BTreeMap;
use std::path::Path;

/// Channels that were chosen on the command line: role and layer, or channels separated by commas.
pub type Named = [(Role, String)];

/// The choice for a sequence, made on its first frame.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// The layout of the file.
    pub layout: Layout,
    /// Channels of each role, in the order of its components.
    pub roles: BTreeMap<Role, Vec<String>>,
}

impl Mapping {
    /// Chooses channels. `view_layer` keeps only layers that begin with it.
    pub fn choose(path: &Path, header: &ExrHeader, named: &Named, view_layer: Option<&str>) -> Result<Self> {
        let inside = |c: &&Channel| view_layer.is_none_or(|v| is_below(v, &c.name));
        let channels: Vec<&Channel> = header.channels.iter().filter(inside).collect();
        let everything = Names::new(channels.iter().copied());
        let layout = everything.layout(header);
        let mut names = Names::new(channels.iter().copied().filter(|c| eye_of(header, &c.name).is_none()));
        let mut roles = BTreeMap::new();
        for role in Role::all() {
            let beauty = roles.get(&Role::Noisy);
            let found = match named.iter().rev().find(|n| n.0 == role) {
                Some((_, name)) if name.eq_ignore_ascii_case("none") => None,
                Some((_, name)) => Some(everything.asked_for(path, role, name, header)?),
                None if role == Role::Alpha => names.alpha(beauty),
                None if role == Role::Noisy => names.colour(path, layout)?,
                None => names.known(role, layout, beauty),
            };
            // The guides of one eye are no guides of the other.
            if let Some(eye) = found.as_ref().filter(|_| role == Role::Noisy).and_then(|f| eye_of(header, &f[0])) {
                names = Names::new(channels.iter().copied().filter(|c| is_below(eye, &c.name)));
            }
            roles.extend(found.map(|found| (role, found)));
        }
        let mapping = Self { layout, roles };
        if !mapping.has_colour() {
            return Err(ToolError::NoColour { path: path.to_owned(), known: list(header), remedy: everything.proposals() });
        }
        mapping.check_types(path, header)?;
        Ok(mapping)
    }

    /// Channels that no role takes, by layers: `albedo.R/G/B`.
    pub fn unused(&self, header: &ExrHeader) -> Vec<String> {
        let is_used = |c: &Channel| self.roles.values().flatten().any(|name| *name == c.name);
        let mut layers: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for channel in header.channels.iter().filter(|c| !is_used(c)) {
            let (layer, component) = split(&channel.name);
            layers.entry(layer).or_default().push(component);
        }
        let told = |(layer, mut components): (&str, Vec<&str>)| {
            components.sort_by_key(|c| (ORDER.find(&c.to_uppercase()).unwrap_or(ORDER.len()), c.to_string()));
            format!("{layer}{}{}", if layer.is_empty() { "" } else { "." }, components.join("/"))
        };
        layers.into_iter().map(told).collect()
    }

    /// Each other eye of the file, with the layer of its picture.
    pub fn other_eyes(&self, header: &ExrHeader) -> Vec<(String, String)> {
        let Some(beauty) = self.roles.get(&Role::Noisy).and_then(|names| names.first()) else { return Vec::new() };
        let own = eye_of(header, beauty);
        let layer = split(beauty).0;
        let bare = own.and_then(|eye| layer.strip_prefix(eye)).unwrap_or(layer).trim_start_matches('.');
        let of = |eye: &String| {
            let layer = if bare.is_empty() { eye.clone() } else { format!("{eye}.{bare}") };
            (eye.clone(), layer)
        };
        header.eyes.iter().filter(|eye| Some(eye.as_str()) != own).map(of).collect()
    }

    /// Other view layers that have a picture of the name of the beauty.
    pub fn other_view_layers(&self, header: &ExrHeader) -> Vec<String> {
        let beauty = self.roles.get(&Role::Noisy).and_then(|names| names.first());
        let Some((view, last)) = beauty.and_then(|name| split(name).0.rsplit_once('.')) else { return Vec::new() };
        let layers = header.channels.iter().map(|c| split(&c.name).0);
        let mut views: Vec<String> = layers
            .filter_map(|layer| layer.rsplit_once('.').filter(|l| l.1 == last && l.0 != view))
            .map(|l| l.0.to_owned())
            .collect();
        views.dedup();
        views
    }

    /// Whether a role has channels.
    pub fn has(&self, role: Role) -> bool {
        self.roles.contains_key(&role)
    }

    /// Whether a role has channels that Blender writes for denoisers.
    pub fn is_for_denoisers(&self, role: Role) -> bool {
        self.roles.get(&role).is_some_and(|names| names.iter().any(|name| name.to_lowercase().contains("denoising ")))
    }

    fn has_colour(&self) -> bool {
        self.has(Role::Noisy)
            || (self.has(Role::Direct) && self.has(Role::Indirect))
            || (self.has(Role::Diffuse) && self.has(Role::Specular))
    }

    /// Whether direct and indirect light can be told apart.
    pub fn has_signals_apart(&self) -> bool {
        let demodulated = self.has(Role::Noisy) && self.has(Role::DemodulatedDirect) && self.has(Role::DiffuseColour);
        (self.has(Role::Direct) && (self.has(Role::Indirect) || self.has(Role::Noisy))) || demodulated
    }

    /// Whether specular light can be told from the rest.
    pub fn has_specular(&self) -> bool {
        let has_all = |roles: &[Role]| roles.iter().all(|role| self.has(*role));
        has_all(&[Role::Diffuse, Role::Specular])
            || (self.has(Role::Noisy)
                && (self.has(Role::Specular)
                    || has_all(&[Role::DemodulatedSpecularDirect, Role::DemodulatedSpecularIndirect, Role::SpecularAlbedo])))
    }

    /// Checks that a file has every chosen channel, with a type that fits. `optional` roles may be missing.
    pub fn check(&self, path: &Path, header: &ExrHeader, optional: impl Fn(Role) -> bool) -> Result<()> {
        for (role, names) in &self.roles {
            for name in names {
                if !optional(*role) && !header.channels.iter().any(|c| c.name == *name) {
                    return Err(ToolError::NoChannel { path: path.to_owned(), channel: name.clone(), known: list(header) });
                }
            }
        }
        self.check_types(path, header)
    }

    fn check_types(&self, path: &Path, header: &ExrHeader) -> Result<()> {
        for (role, names) in &self.roles {
            let found = names.iter().filter_map(|n| header.channels.iter().find(|c| c.name == *n));
            for channel in found {
                if channel.sample_type == SampleType::U32 && role.kind() != Kind::Id {
                    return Err(ToolError::ChannelType {
                        path: path.to_owned(),
                        channel: channel.name.clone(),
                        given: "unsigned integers",
                        needed: "it must hold half or float. Write it as float, or choose another one with --channel",
                    });
                }
            }
        }
        Ok(())
    }
}

/// Components in the order in which they are told.
const ORDER: &str = "RGBAXYZUVWID";

/// Whether a channel is in a layer, or in one below it.
fn is_below(layer: &str, channel: &str) -> bool {
    channel.strip_prefix(layer).is_some_and(|rest| rest.starts_with('.'))
}

/// The eye that a channel is of, where it is not the first one.
fn eye_of<'a>(header: &'a ExrHeader, channel: &str) -> Option<&'a str> {
    header.eyes.iter().map(String::as_str).find(|eye| is_below(eye, channel))
}

/// Layer and last part of a channel name.
pub fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

/// A name as a shell takes it.
fn quoted(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '.' | '_' | '-' | '/');
    if name.chars().all(is_plain) {
        name.to_owned()
    } else {
        format!("\"{name}\"")
    }
}

/// Names of all channels, shortened where there are many.
pub fn list(header: &ExrHeader) -> String {
    const SHOWN: usize = 48;
    let names: Vec<&str> = header.channels.iter().take(SHOWN).map(|c| c.name.as_str()).collect();
    let more = header.channels.len().saturating_sub(SHOWN);
    format!("{}{}", names.join(", "), if more > 0 { format!(" and {more} more") } else { String::new() })
}

/// Channels to choose from.
struct Names<'a> {
    channels: Vec<&'a Channel>,
    lower: Vec<String>,
}

impl<'a> Names<'a> {
    fn new(channels: impl Iterator<Item = &'a Channel>) -> Self {
        let channels: Vec<&Channel> = channels.collect();
        let lower = channels.iter().map(|c| c.name.to_lowercase()).collect();
        Self { channels, lower }
    }

    fn layout(&self, header: &ExrHeader) -> Layout {
        let layers: Vec<String> = self.lower.iter().map(|name| split(name).0.to_owned()).collect();
        let of_parts = header.parts.iter().flat_map(|part| &part.other);
        let text = |value: &AttributeValue| match value {
            AttributeValue::Text(text) => text.to_string(),
            _ => String::new(),
        };
        let attributes: Vec<String> =
            header.shared.other.iter().chain(of_parts).map(|(name, value)| format!("{name}={}", text(value))).collect();
        recognise(&layers, &self.lower, &attributes)
    }

    fn find(&self, lower: &str) -> Option<String> {
        self.lower.iter().position(|l| l == lower).map(|i| self.channels[i].name.clone())
    }

    /// The channels of a layer (its name in lower case) with one of the sets of components.
    fn layer(&self, layer: &str, components: &[&[&str]]) -> Option<Vec<String>> {
        let dot = if layer.is_empty() { "" } else { "." };
        components.iter().find_map(|set| set.iter().map(|c| self.find(&format!("{layer}{dot}{}", c.to_lowercase()))).collect())
    }

    fn known(&self, role: Role, layout: Layout, beauty: Option<&Vec<String>>) -> Option<Vec<String>> {
        let rows = ENTRIES.iter().filter(|e| e.role == role && (e.layouts.is_empty() || e.layouts.contains(&layout)));
        rows.flat_map(|e| e.layers.iter().map(move |l| (e, *l))).find_map(|(e, l)| self.entry(e, l, beauty))
    }

    /// A layer that ends like the entry, in the same view layer as the beauty where there are several.
    fn entry(&self, entry: &Entry, ending: &str, beauty: Option<&Vec<String>>) -> Option<Vec<String>> {
        let view = beauty.and_then(|b| split(&b[0]).0.rsplit_once('.')).map(|(view, _)| view.to_lowercase());
        let fits = |layer: &str| match layer.strip_suffix(ending) {
            Some("") => true,
            Some(rest) => !ending.is_empty() && rest.ends_with('.'),
            None => false,
        };
        let mut layers: Vec<&str> = self.lower.iter().map(|name| split(name).0).filter(|l| fits(l)).collect();
        layers.dedup();
        let in_view = |l: &&&str| view.as_ref().is_some_and(|v| l.starts_with(&format!("{v}.")));
        let preferred = layers.iter().find(in_view).or(layers.first());
        let whole = || {
            (entry.role.kind().components() == 1 && !ending.is_empty()).then(|| self.find(ending).map(|name| vec![name])).flatten()
        };
        preferred.and_then(|l| self.layer(l, entry.components)).or_else(whole)
    }

    /// Layers as they are written, of colours with these last components, but for cryptomattes.
    fn colours(&self, components: &[&str]) -> Vec<&str> {
        let has_all = |layer: &str| components.iter().all(|c| self.lower.iter().any(|l| split(l) == (layer, *c)));
        let is_matte = |layer: &str| layer.rsplit('.').next().is_some_and(|last| last.contains("crypto"));
        let mut found: Vec<&str> = Vec::new();
        for (channel, lower) in self.channels.iter().zip(&self.lower) {
            let layer = split(&channel.name).0;
            if !found.contains(&layer) && !is_matte(split(lower).0) && has_all(split(lower).0) {
                found.push(layer);
            }
        }
        found
    }

    /// The picture: of a name that is known, or the only layer with R, G, B and A. Mitsuba names it
    /// after the integrator, others as they like; of two, only the user knows.
    fn colour(&self, path: &Path, layout: Layout) -> Result<Option<Vec<String>>> {
        let known = self.known(Role::Noisy, layout, None);
        if known.is_some() {
            return Ok(known);
        }
        match self.colours(&["r", "g", "b", "a"])[..] {
            [] => Ok(None),
            [layer] => Ok(self.layer(&layer.to_lowercase(), &[&["R", "G", "B"]])),
            ref several => Err(ToolError::SeveralColours {
                path: path.to_owned(),
                layers: several.iter().map(|layer| format!("--channel noisy={}", quoted(layer))).collect(),
            }),
        }
    }

    /// What the user can type where no colour was recognised.
    fn proposals(&self) -> String {
        let (mut colours, mut grey) = (self.colours(&["r", "g", "b"]), self.colours(&["y"]));
        let is_guide = |layer: &&str| {
            let last = layer.rsplit('.').next().unwrap_or_default().to_lowercase();
            !last.is_empty() && ENTRIES.iter().any(|e| e.role != Role::Noisy && e.layers.contains(&last.as_str()))
        };
        colours.retain(|layer| !is_guide(layer));
        grey.retain(|layer| !is_guide(layer));
        let grey = grey.into_iter().map(|layer| if layer.is_empty() { "Y".to_owned() } else { format!("{layer}.Y") });
        let all: Vec<String> = colours.into_iter().map(str::to_owned).chain(grey).collect();
        match all.is_empty() {
            true => "name it with --channel noisy=LAYER, or noisy=CHANNEL where it is grey".to_owned(),
            false => {
                let options: Vec<_> = all.iter().map(|name| format!("--channel noisy={}", quoted(name))).collect();
                format!("name it with {}", options.join(" or "))
            }
        }
    }

    /// The alpha that belongs to the beauty.
    fn alpha(&self, beauty: Option<&Vec<String>>) -> Option<Vec<String>> {
        let layer = split(beauty?.first()?).0.to_lowercase();
        self.layer(&layer, &[&["A"]]).or_else(|| self.layer("alpha", &[&["A"], &["R"], &["Y"], &["V"], &["X"]]))
    }

    fn asked_for(&self, path: &Path, role: Role, name: &str, header: &ExrHeader) -> Result<Vec<String>> {
        let missing = || ToolError::NoChannel { path: path.to_owned(), channel: name.to_owned(), known: list(header) };
        let wanted = role.kind().components();
        let parts: Vec<&str> = name.split(',').map(str::trim).collect();
        if parts.len() == wanted && parts.iter().all(|p| self.find(&p.to_lowercase()).is_some()) {
            return Ok(parts.iter().filter_map(|p| self.find(&p.to_lowercase())).collect());
        }
        if parts.len() != 1 {
            return Err(missing());
        }
        // One channel where there are three: grey.
        let grey = |channel: &str| self.find(channel).map(|name| vec![name; 3]);
        if let Some(grey) = grey(&name.to_lowercase()).filter(|_| role.kind() == Kind::Colour) {
            return Ok(grey);
        }
        let sets = ENTRIES.iter().filter(|e| e.role == role).map(|e| e.components);
        let layer = name.to_lowercase();
        let found = sets.into_iter().find_map(|s| self.layer(&layer, s));
        let is_colour = role.kind() == Kind::Colour;
        found.or_else(|| grey(&format!("{layer}.y")).filter(|_| is_colour)).ok_or_else(missing)
    }
}
