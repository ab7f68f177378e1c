//! Rows of numbers that begin where a line of the cache does.

/// Rows of equal length, one after another. Reading across two lines of the cache takes two accesses, so a chosen
/// number of the first row begins one; that of every row does if the rows are whole lines apart.
pub(crate) struct Rows {
    memory: Vec<f64>,
    begin: usize,
    count: usize,
    n: usize,
    stride: usize,
}

/// Doubles of a line of the cache.
pub(crate) const LINE: usize = 8;

impl Rows {
    /// `count` rows of `n` zeros, each of which begins a line.
    pub(crate) fn new(count: usize, n: usize) -> Rows {
        Rows::apart(count, n, n.max(1).next_multiple_of(LINE), 0)
    }

    /// `count` rows of `n` zeros, each `stride` numbers behind the one before. Number `first` of the first row begins a
    /// line.
    pub(crate) fn apart(count: usize, n: usize, stride: usize, first: usize) -> Rows {
        let mut memory = vec![0.0; count * stride + LINE - 1];
        let begin = memory[first % LINE..].as_ptr().align_offset(LINE * size_of::<f64>());
        // where that is not known, any place will do
        let begin = if begin < LINE { begin } else { 0 };
        memory.truncate(begin + count * stride);
        Rows { memory, begin, count, n, stride }
    }

    /// How many there are.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// From the beginning of one row to that of the next.
    #[inline(always)]
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    #[inline(always)]
    pub(crate) fn row(&self, j: usize) -> &[f64] {
        &self.all()[j * self.stride..][..self.n]
    }

    pub(crate) fn row_mut(&mut self, j: usize) -> &mut [f64] {
        let from = self.begin + j * self.stride;
        &mut self.memory[from..][..self.n]
    }

    /// All of them, with the padding between them.
    #[inline(always)]
    pub(crate) fn all(&self) -> &[f64] {
        &self.memory[self.begin..]
    }

    /// As [`Rows::all`].
    pub(crate) fn all_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.begin..]
    }

    /// One after another, with their padding.
    #[inline(always)]
    pub(crate) fn iter(&self) -> std::slice::ChunksExact<'_, f64> {
        self.all().chunks_exact(self.stride)
    }
}
