//! Arguments of a node, by name: each is asked for once, and one that nobody asked for is refused.

use super::values::{Kind, Value};
use super::GraphState;
use crate::convert::{eaw_weights, flag};
use crate::functions::string;
use crate::status::Failure;
use crate::structs::{AtrousArgument, AtrousArgumentKind};
use atrous::config::EawWeights;
use atrous::{graph, Choice, Tuning};

/// What a host gave under a name.
#[derive(Clone, Debug)]
pub(super) enum Content {
    Port(Value),
    /// The content of a frame ago.
    Previous(Value),
    Number(f64),
    Text(String),
    /// A specialisation constant.
    Constant(u32),
}

impl Content {
    fn name(&self) -> &'static str {
        match self {
            Self::Port(value) => value.name(),
            Self::Previous(_) => "the previous content of a port",
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::Constant(_) => "a constant",
        }
    }
}

/// The arguments of a node.
pub(super) struct Arguments<'n> {
    node: &'n str,
    given: Vec<(String, Content)>,
    /// Names that the node asked for.
    known: Vec<&'static str>,
}

impl<'n> Arguments<'n> {
    /// Reads them. An argument whose port is 0 is left out.
    ///
    /// # Safety
    /// `arguments` is null or points to `count` of them, with strings that are null or end in a null.
    pub(super) unsafe fn read(
        node: &'n str,
        state: &GraphState,
        arguments: *const AtrousArgument,
        count: u32,
    ) -> Result<Self, Failure> {
        const MOST: u32 = 256;
        if count > MOST || arguments.is_null() && count > 0 {
            let problem = if count > MOST { format!("at most {MOST} are read") } else { "arguments is NULL".to_owned() };
            return Err(Failure::argument(format!("{node}: {count} arguments were given, but {problem}")));
        }
        let mut given: Vec<(String, Content)> = Vec::new();
        for i in 0..count as usize {
            // SAFETY: there are `count` of them, and i is below that; strings are null or end in a null.
            let (argument, name) = unsafe {
                let argument = arguments.add(i).read_unaligned();
                (argument, string(&format!("{node}: name of argument {i}"), argument.name)?)
            };
            if given.iter().any(|(other, _)| *other == name) {
                return Err(Failure::argument(format!("{node}: {name} is given twice; give it once")));
            }
            // SAFETY: its strings are null or end in a null.
            if let Some(content) = unsafe { content(&format!("{node}: {name}"), state, &argument)? } {
                given.push((name, content));
            }
        }
        Ok(Self { node, given, known: Vec::new() })
    }

    /// All of them, for a stage, whose shader has the names.
    pub(super) fn all(self) -> Vec<(String, Content)> {
        self.given
    }

    /// Refuses what the node did not ask for.
    pub(super) fn finish(self) -> Result<(), Failure> {
        match self.given.first() {
            None => Ok(()),
            Some((name, _)) => {
                let known = if self.known.is_empty() { "none".to_owned() } else { self.known.join(", ") };
                Err(Failure::argument(format!("{}: there is no argument {name}; the arguments are: {known}", self.node)))
            }
        }
    }

    fn take(&mut self, name: &'static str) -> Option<Content> {
        self.known.push(name);
        let at = self.given.iter().position(|(given, _)| given == name)?;
        Some(self.given.remove(at).1)
    }

    fn wrong(&self, name: &str, content: &Content, needed: &str) -> Failure {
        Failure::argument(format!("{}: {name} is {}; give {needed}", self.node, content.name()))
    }

    fn missing(&self, name: &str, needed: &str) -> Failure {
        Failure::argument(format!("{}: {name} is missing; give {needed}", self.node))
    }

    /// A port that the node needs, or another value of a graph.
    pub(super) fn port<K: Kind>(&mut self, name: &'static str) -> Result<K, Failure> {
        self.optional(name, None)?.ok_or_else(|| self.missing(name, K::NAME))
    }

    pub(super) fn optional<K: Kind>(&mut self, name: &'static str, default: Option<K>) -> Result<Option<K>, Failure> {
        match self.take(name) {
            None => Ok(default),
            Some(Content::Port(value)) if K::of(&value).is_some() => Ok(K::of(&value)),
            Some(other) => Err(self.wrong(name, &other, K::NAME)),
        }
    }

    /// A value of any kind.
    pub(super) fn any(&mut self, name: &'static str) -> Result<Value, Failure> {
        match self.take(name) {
            Some(Content::Port(value)) => Ok(value),
            Some(other) => Err(self.wrong(name, &other, "a port")),
            None => Err(self.missing(name, "a port")),
        }
    }

    pub(super) fn text(&mut self, name: &'static str) -> Result<String, Failure> {
        match self.take(name) {
            Some(Content::Text(text)) => Ok(text),
            Some(other) => Err(self.wrong(name, &other, "a text")),
            None => Err(self.missing(name, "a text")),
        }
    }

    fn whole(&mut self, name: &'static str) -> Result<Option<u32>, Failure> {
        match self.take(name) {
            None => Ok(None),
            Some(Content::Number(number)) if number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0 => {
                Ok(Some(number as u32))
            }
            Some(Content::Number(number)) => {
                Err(Failure::argument(format!("{}: {name} is {number}; give a whole number from 0 to {}", self.node, u32::MAX)))
            }
            Some(other) => Err(self.wrong(name, &other, "a number")),
        }
    }

    /// A whole number that the node needs.
    pub(super) fn count(&mut self, name: &'static str) -> Result<u32, Failure> {
        self.whole(name)?.ok_or_else(|| self.missing(name, "a number"))
    }

    pub(super) fn number(&mut self, name: &'static str, default: u32) -> Result<u32, Failure> {
        Ok(self.whole(name)?.unwrap_or(default))
    }

    pub(super) fn flag(&mut self, name: &'static str, default: bool) -> Result<bool, Failure> {
        self.whole(name)?.map_or(Ok(default), |number| flag(&format!("{}: {name}", self.node), number))
    }

    pub(super) fn weights(&mut self, name: &'static str, default: EawWeights) -> Result<EawWeights, Failure> {
        self.whole(name)?.map_or(Ok(default), eaw_weights)
    }

    /// A choice by its name.
    pub(super) fn choice<T: Choice>(&mut self, name: &'static str, default: T) -> Result<T, Failure> {
        match self.take(name) {
            None => Ok(default),
            Some(Content::Text(text)) => {
                text.parse().map_err(|error: atrous::Error| Failure::argument(format!("{}: {name}: {error}", self.node)))
            }
            Some(other) => Err(self.wrong(name, &other, &format!("a text: {}", allowed::<T>()))),
        }
    }

    /// A fixed number, or the name of a tunable.
    pub(super) fn value(&mut self, name: &'static str, default: graph::Value) -> Result<graph::Value, Failure> {
        match self.take(name) {
            None => Ok(default),
            Some(content) => value_of(&content).ok_or_else(|| {
                self.wrong(name, &content, "a number, or as a text the name of a tunable (atrous_tuning_field lists them)")
            }),
        }
    }
}

fn allowed<T: Choice>() -> String {
    T::ALL.iter().map(|value| value.name()).collect::<Vec<_>>().join(", ")
}

/// A number of a node: fixed, or the tunable of a name.
pub(super) fn value_of(content: &Content) -> Option<graph::Value> {
    match content {
        Content::Number(number) => Some(graph::Value::Fixed(*number as f32)),
        Content::Text(text) => {
            let field = Tuning::FIELDS.iter().find(|field| field.name == text.as_str())?;
            Some(graph::Value::Tunable(field.name))
        }
        _ => None,
    }
}

/// What an argument has; `None`: a port of 0, which leaves it out.
///
/// # Safety
/// Its text is null or a string with a null at its end.
unsafe fn content(what: &str, state: &GraphState, given: &AtrousArgument) -> Result<Option<Content>, Failure> {
    let kind: AtrousArgumentKind = given.kind.try_into().map_err(|()| {
        let allowed = "0 (a port), 1 (its previous content), 2 (a number), 3 (a text), 4 (a constant)";
        Failure::argument(format!("{what} has the kind {}; allowed: {allowed}", given.kind))
    })?;
    Ok(Some(match kind {
        AtrousArgumentKind::Port | AtrousArgumentKind::Previous if given.port == 0 => return Ok(None),
        AtrousArgumentKind::Port => Content::Port(state.value(what, given.port)?),
        AtrousArgumentKind::Previous => Content::Previous(state.value(what, given.port)?),
        AtrousArgumentKind::Number if !given.number.is_finite() => {
            return Err(Failure::argument(format!("{what} is {}; give a finite number", given.number)));
        }
        AtrousArgumentKind::Number => Content::Number(given.number),
        // SAFETY: the text is null or a string with a null at its end.
        AtrousArgumentKind::Text => Content::Text(unsafe { string(what, given.text)? }),
        AtrousArgumentKind::Constant if (0.0..=f64::from(u32::MAX)).contains(&given.number) => {
            Content::Constant(given.number as u32)
        }
        AtrousArgumentKind::Constant => {
            return Err(Failure::argument(format!("{what} is {}; give a constant from 0 to {}", given.number, u32::MAX)));
        }
    }))
}
