//! The entropy of two maps laid over each other.

use crate::JointCounts;

/// Which histogram the entropy is taken of; the paper names none, and the choice decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EntropyHistogram {
    /// The nine pairs of classes. Where less than half of the maps overlap, more overlap can mean
    /// less of it, right or wrong: then its least value lies at the rim of the window.
    Joint,
    /// The four pairs of cells known in both maps. Least within a cell of the right translation
    /// whatever the overlap, so the default.
    #[default]
    KnownInBoth,
    /// Occupied, free, unknown, and conflict, as one fused map shows them.
    ConflictLabel,
    /// Grey levels of the mean picture, in which a conflict looks unknown: its least entropy is
    /// off by several cells.
    AveragedGrey,
}

/// H = −Σ p log₂ p over the normalised `counts`, in bits; nothing counts 0 (Saeedi et al., Eq. 21).
#[must_use]
pub fn entropy(counts: &[usize]) -> f64 {
    let total: usize = counts.iter().sum();
    let shares = counts.iter().filter(|&&count| count > 0);
    shares.map(|&count| count as f64 / total as f64).map(|p| -p * p.log2()).sum::<f64>().abs()
}

/// The entropy of two maps laid over each other, in bits.
#[must_use]
pub fn joint_entropy(counts: &JointCounts, histogram: EntropyHistogram) -> f64 {
    let c = counts;
    match histogram {
        EntropyHistogram::Joint => entropy(&[
            c.both_occupied,
            c.both_free,
            c.occupied_free,
            c.free_occupied,
            c.occupied_unknown,
            c.free_unknown,
            c.unknown_occupied,
            c.unknown_free,
            c.both_unknown,
        ]),
        EntropyHistogram::KnownInBoth => {
            entropy(&[c.both_occupied, c.both_free, c.occupied_free, c.free_occupied])
        }
        EntropyHistogram::ConflictLabel => entropy(&[
            c.both_occupied + c.occupied_unknown + c.unknown_occupied,
            c.both_free + c.free_unknown + c.unknown_free,
            c.disagreement(),
            c.both_unknown,
        ]),
        EntropyHistogram::AveragedGrey => entropy(&[
            c.both_occupied,
            c.occupied_unknown + c.unknown_occupied,
            c.disagreement() + c.both_unknown,
            c.free_unknown + c.unknown_free,
            c.both_free,
        ]),
    }
}

#[cfg(test)]
mod tests {
    use super::entropy;

    #[test]
    fn t_s7_entropies_of_four_histograms() {
        assert_eq!(entropy(&[8, 4, 4]), 1.5);
        assert_eq!(entropy(&[16, 0, 0]), 0.0);
        assert_eq!(entropy(&[4, 4, 4, 4]), 2.0);
        assert_eq!(entropy(&[]), 0.0);
    }
}
