//! Patterns for the names of frames: `*`, `?`, `####` and `%04d`.

#[derive(Clone, Copy, PartialEq)]
enum Piece {
    Char(char),
    AnyChar,
    Digit,
    Any,
    Digits,
}

/// Stands for the number in [`Pattern::number`]; no file is called so.
const NUMBER: char = '\u{0}';

/// A pattern, taken apart.
pub struct Pattern(Vec<Piece>);

impl Pattern {
    /// Takes a pattern apart. There is no wrong one.
    pub fn parse(text: &str) -> Self {
        let mut pieces = Vec::new();
        let mut rest = text;
        while let Some(c) = rest.chars().next() {
            rest = &rest[c.len_utf8()..];
            pieces.push(match c {
                '*' => Piece::Any,
                '?' => Piece::AnyChar,
                '#' => Piece::Digit,
                '%' => match rest.split_once('d') {
                    Some((width, after)) if width.chars().all(|c| c.is_ascii_digit()) => {
                        rest = after;
                        Piece::Digits
                    }
                    _ => Piece::Char(c),
                },
                c => Piece::Char(c),
            });
        }
        Self(pieces)
    }

    /// The place of the frame's number among the runs of digits of a name that fits: where the
    /// pattern has `%04d` or `####`. None where it has neither.
    pub fn number(&self, name: &str) -> Option<usize> {
        let is_number = |piece: &Piece| matches!(piece, Piece::Digits | Piece::Digit);
        let last = self.0.iter().rposition(is_number)?;
        let first = match self.0[last] {
            Piece::Digit => self.0[..last].iter().rposition(|p| *p != Piece::Digit).map_or(0, |i| i + 1),
            _ => last,
        };
        let digits = (self.0[last] == Piece::Digit).then_some(last + 1 - first);
        let marked = Self([&self.0[..first], &[Piece::Char(NUMBER)], &self.0[last + 1..]].concat());
        let runs = crate::frame_names::digits(name);
        runs.iter().position(|run| {
            digits.is_none_or(|digits| digits == run.len())
                && marked.fits(&format!("{}{NUMBER}{}", &name[..run.start], &name[run.end..]))
        })
    }

    /// Iterative, with one point to return to: linear in practice, and no pattern makes it blow up.
    pub fn fits(&self, name: &str) -> bool {
        let name: Vec<char> = name.chars().collect();
        let (mut p, mut n, mut star) = (0, 0, None);
        while n < name.len() {
            let advance = match self.0.get(p) {
                Some(Piece::Any) => {
                    star = Some((p, n, false));
                    p += 1;
                    continue;
                }
                Some(Piece::Digits) if name[n].is_ascii_digit() => {
                    star = Some((p, n + 1, true));
                    true
                }
                Some(Piece::Char(c)) => *c == name[n],
                Some(Piece::AnyChar) => true,
                Some(Piece::Digit) => name[n].is_ascii_digit(),
                Some(Piece::Digits) | None => false,
            };
            if advance {
                (p, n) = (p + 1, n + 1);
                continue;
            }
            match star {
                Some((back, at, digits)) if !digits || name[at].is_ascii_digit() => {
                    star = Some((back, at + 1, digits));
                    (p, n) = (back + 1, at + 1);
                }
                _ => return false,
            }
        }
        self.0[p..].iter().all(|piece| *piece == Piece::Any)
    }
}
