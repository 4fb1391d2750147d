//! Sharing of memory between transients whose lifetimes do not overlap.

/// One thing to place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// Index of the first pass that uses it.
    pub first: usize,
    /// Index of the last pass that uses it.
    pub last: usize,
    /// Bytes.
    pub size: u64,
    /// Alignment of the offset; at least 1.
    pub alignment: u64,
}

impl Span {
    fn overlaps(&self, other: &Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }
}

/// An offset for every span, and the bytes needed in all. Largest first, each at the lowest offset that is free during its whole
/// life.
pub(crate) fn alias(spans: &[Span]) -> (Vec<u64>, u64) {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|&i| (std::cmp::Reverse(spans[i].size), spans[i].first, i));
    let mut offsets = vec![0; spans.len()];
    let mut placed: Vec<usize> = Vec::new();
    let mut total = 0;
    for i in order {
        let mut busy: Vec<_> =
            placed.iter().filter(|&&j| spans[j].overlaps(&spans[i])).map(|&j| (offsets[j], offsets[j] + spans[j].size)).collect();
        busy.sort_unstable();
        let mut offset: u64 = 0;
        for (start, end) in busy {
            if offset + spans[i].size <= start {
                break;
            }
            offset = offset.max(end.next_multiple_of(spans[i].alignment.max(1)));
        }
        offsets[i] = offset;
        total = total.max(offset + spans[i].size);
        placed.push(i);
    }
    (offsets, total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(first: usize, last: usize, size: u64) -> Span {
        Span { first, last, size, alignment: 4 }
    }

    #[test]
    fn lifetimes_that_do_not_overlap_share() {
        let (offsets, total) = alias(&[span(0, 1, 8), span(2, 3, 8)]);
        assert_eq!((offsets, total), (vec![0, 0], 8));
    }

    #[test]
    fn a_shared_pass_is_an_overlap() {
        assert_eq!(alias(&[span(0, 2, 8), span(2, 3, 8)]).1, 16);
    }

    #[test]
    fn a_gap_is_filled() {
        let spans = [span(0, 5, 8), span(0, 1, 4), span(2, 3, 4), span(4, 5, 4)];
        assert_eq!(alias(&spans).1, 12);
    }

    #[test]
    fn no_two_live_spans_share_a_byte() {
        let spans: Vec<_> =
            (0..40u64).map(|i| span((i * 7 % 13) as usize, (i * 7 % 13 + i % 4) as usize, 4 + i * 37 % 64)).collect();
        let (offsets, total) = alias(&spans);
        for i in 0..spans.len() {
            assert_eq!(offsets[i] % 4, 0);
            assert!(offsets[i] + spans[i].size <= total);
            for j in 0..i {
                let apart = offsets[i] + spans[i].size <= offsets[j] || offsets[j] + spans[j].size <= offsets[i];
                assert!(apart || !spans[i].overlaps(&spans[j]), "{i} and {j}");
            }
        }
        assert!(total < spans.iter().map(|s| s.size).sum::<u64>());
    }
}
