//! Choices that follow from a seed.

use crate::support::scene::hash;

#[derive(Clone)]
pub struct Dice {
    seed: u32,
    thrown: u32,
}

impl Dice {
    pub fn new(seed: u32) -> Self {
        Self { seed, thrown: 0 }
    }

    /// A number from 0, below `sides`.
    pub fn below(&mut self, sides: u32) -> u32 {
        self.thrown += 1;
        hash(self.seed, self.thrown, 12) % sides
    }

    pub fn coin(&mut self) -> bool {
        self.below(2) == 1
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len() as u32) as usize]
    }

    /// One of `count` numbers from `first`, the same whenever it is asked for.
    pub fn same(&self, first: u32, count: u32) -> u32 {
        first + hash(self.seed, 0, 13) % count
    }
}
