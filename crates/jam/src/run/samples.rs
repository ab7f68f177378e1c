//! Samples of a run at regular times.

/// Samples at times 0, d, 2d, ... up to the end of a run or the event that ended them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// The times.
    pub times: Vec<f64>,
    /// The standard deviation of the speeds over the pedestrians at each time (divided by `N`).
    pub std: Vec<f64>,
    /// Positions, unwrapped: `pedestrians` of them for each time, one time after the other.
    pub positions: Vec<f64>,
    /// Speeds, in the same order.
    pub speeds: Vec<f64>,
    /// How many pedestrians are kept at each time: all, or none.
    pub pedestrians: usize,
}

/// One instant of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<'a> {
    /// The time.
    pub time: f64,
    /// The standard deviation of the speeds over the pedestrians (divided by `N`).
    pub std: f64,
    /// Positions, unwrapped: they start in [0, L) and grow as the pedestrians walk. Empty where they are not kept.
    pub positions: &'a [f64],
    /// Speeds. Empty where they are not kept.
    pub speeds: &'a [f64],
    /// Spacings to the pedestrians ahead, with all their digits. Empty where trajectories are not kept, and in samples
    /// read from [`Samples`], where they are differences of positions.
    pub spacings: &'a [f64],
}

impl Samples {
    /// None yet, of which each will hold this many pedestrians.
    pub(crate) fn new(pedestrians: usize) -> Samples {
        Samples { pedestrians, ..Samples::default() }
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The samples in order of time.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Sample<'_>> {
        (0..self.len()).map(|index| self.at(index))
    }

    /// The last sample; `None` before the first.
    pub fn last(&self) -> Option<Sample<'_>> {
        self.len().checked_sub(1).map(|index| self.at(index))
    }

    /// The sample of this index, below [`Samples::len`].
    pub fn at(&self, index: usize) -> Sample<'_> {
        let row = index * self.pedestrians..(index + 1) * self.pedestrians;
        let (positions, speeds) = (&self.positions[row.clone()], &self.speeds[row]);
        Sample { time: self.times[index], std: self.std[index], positions, speeds, spacings: &[] }
    }

    pub(crate) fn push(&mut self, Sample { time, std, positions, speeds, .. }: Sample<'_>) {
        self.times.push(time);
        self.std.push(std);
        self.positions.extend_from_slice(positions);
        self.speeds.extend_from_slice(speeds);
    }
}
