//! Choices that follow from bytes.

/// Choices that bytes make. Behind their end each is the last one that there is, which is the usual one where that matters.
#[derive(Clone)]
pub struct Choices<'a> {
    bytes: &'a [u8],
}

impl<'a> Choices<'a> {
    /// Starts with the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*first)
    }

    /// A number from 0, below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        let drawn = if end <= 256 { self.take().map(|[b]| usize::from(b)) } else { self.word().map(|w| w as usize) };
        drawn.map_or(end.saturating_sub(1), |drawn| drawn % end.max(1))
    }

    /// True once in so many times.
    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// One of a list that is not empty.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// 32 bits, where there are as many.
    pub fn word(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    /// 32 bits, most of them at an end of some range.
    pub fn odd(&mut self) -> u32 {
        const ODD: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 16, 255, 16384, 16385, 1 << 31, u32::MAX - 1, u32::MAX];
        match self.below(17) {
            16 => self.word().unwrap_or(1),
            at => ODD[at],
        }
    }

    /// A float, most of them such as no host should give.
    pub fn odd_float(&mut self) -> f32 {
        const ODD: [f32; 11] = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-45, f32::MAX, f32::MIN, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        match self.below(12) {
            11 => self.word().map_or(1.0, f32::from_bits),
            at => ODD[at],
        }
    }
}
