//! The map from the channels of a file to their roles.

use crate::error::{Result, ToolError};
use crate::exr_header::{Channel, ExrHeader};
use crate::layouts::{recognise, Entry, Layout, ENTRIES};
use crate::roles::{Kind, Role};
use exr::meta::attribute::SampleType;
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
        let inside = |c: &&Channel| view_layer.is_none_or(|v| c.name.strip_prefix(v).is_some_and(|rest| rest.starts_with('.')));
        let channels: Vec<&Channel> = header.channels.iter().filter(inside).collect();
        let lower: Vec<String> = channels.iter().map(|c| c.name.to_lowercase()).collect();
        let layers: Vec<String> = lower.iter().map(|name| split(name).0.to_owned()).collect();
        let layout = recognise(&layers, &lower);
        let names = Names { channels: &channels, lower: &lower };
        let mut roles = BTreeMap::new();
        for role in Role::all() {
            let found = match named.iter().rev().find(|n| n.0 == role) {
                Some((_, name)) if name.eq_ignore_ascii_case("none") => None,
                Some((_, name)) => Some(names.asked_for(path, role, name, header)?),
                None if role == Role::Alpha => names.alpha(roles.get(&Role::Noisy)),
                None => names.known(role, layout, roles.get(&Role::Noisy)),
            };
            if let Some(found) = found {
                roles.insert(role, found);
            }
        }
        let mapping = Self { layout, roles };
        if !mapping.has_colour() {
            return Err(ToolError::NoColour { path: path.to_owned(), known: list(header) });
        }
        mapping.check_types(path, header)?;
        Ok(mapping)
    }

    /// Whether a role has channels.
    pub fn has(&self, role: Role) -> bool {
        self.roles.contains_key(&role)
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

/// Layer and last part of a channel name.
pub fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

/// Names of all channels, shortened where there are many.
pub fn list(header: &ExrHeader) -> String {
    const SHOWN: usize = 48;
    let names: Vec<&str> = header.channels.iter().take(SHOWN).map(|c| c.name.as_str()).collect();
    let more = header.channels.len().saturating_sub(SHOWN);
    format!("{}{}", names.join(", "), if more > 0 { format!(" and {more} more") } else { String::new() })
}

struct Names<'a> {
    channels: &'a [&'a Channel],
    lower: &'a [String],
}

impl Names<'_> {
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
        let found = rows.flat_map(|e| e.layers.iter().map(move |l| (e, *l))).find_map(|(e, l)| self.entry(e, l, beauty));
        match role {
            Role::Noisy => found.or_else(|| self.only_rgba()),
            _ => found,
        }
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

    /// Mitsuba names the image after the nested integrator, so any name is possible: a layer with R, G, B and A.
    fn only_rgba(&self) -> Option<Vec<String>> {
        let mut layers = self.lower.iter().map(|name| split(name)).filter(|(_, last)| *last == "a").map(|(layer, _)| layer);
        let layer = layers.next()?;
        self.layer(layer, &[&["R", "G", "B"]])
    }

    /// The alpha that belongs to the beauty.
    fn alpha(&self, beauty: Option<&Vec<String>>) -> Option<Vec<String>> {
        let layer = split(beauty?.first()?).0.to_lowercase();
        self.layer(&layer, &[&["A"]])
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
        let sets = ENTRIES.iter().filter(|e| e.role == role).map(|e| e.components);
        let layer = name.to_lowercase();
        sets.into_iter().find_map(|s| self.layer(&layer, s)).ok_or_else(missing)
    }
}
