//! The state of a judge as numbers, for checkpoints.

use super::repeats::{Reference, Repeats};
use super::windows::Stretch;
use super::{Class, Decision, Verdict};

/// The state of a [`Judge`](super::Judge), from which it can continue later.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// The judge's own.
    pub(super) numbers: [f64; 6],
    pub(super) blocks: Vec<Stretch>,
    pub(super) block: Stretch,
    pub(super) repeats: Repeats,
    pub(super) verdict: Option<Verdict>,
}

/// Numbers that make a stretch.
const OF_STRETCH: usize = 8;

impl Memory {
    /// As numbers, for [`Memory::parse`].
    pub fn to_numbers(&self) -> Vec<f64> {
        let mut all = self.numbers.to_vec();
        all.push(self.blocks.len() as f64);
        for stretch in self.blocks.iter().chain([&self.block]) {
            all.extend(stretch.to_numbers());
        }
        all.push(f64::from(self.repeats.times));
        match &self.repeats.reference {
            None => all.push(0.0),
            Some(reference) => {
                all.extend([reference.gaps.len() as f64, reference.time, reference.pedestrian as f64]);
                all.extend(reference.gaps.iter().chain(&reference.speeds));
            }
        }
        if let Some(verdict) = &self.verdict {
            let index =
                |is_before: &dyn Fn(&Class) -> bool| Class::ALL.iter().take_while(|class| is_before(class)).count();
            let class = index(&|class| *class != verdict.class);
            let decision = KEPT.iter().take_while(|decision| **decision != verdict.decision).count();
            let Verdict { time, backward_flow, least_gap, least_speed, std, distance, .. } = verdict;
            let backward = if *backward_flow { 1.0 } else { 0.0 };
            all.extend([class as f64, decision as f64, *time, backward, *least_gap, *least_speed, *std, *distance]);
            // both of waves, none of anything else
            all.extend(verdict.wave_speed.zip(verdict.lasting_least_speed).into_iter().flat_map(|(c, v)| [c, v]));
        }
        all
    }

    /// What [`Memory::to_numbers`] wrote; `None` for anything else.
    pub fn parse(numbers: &[f64]) -> Option<Memory> {
        let mut rest = numbers;
        let mut take = |count: usize| -> Option<&[f64]> {
            let (taken, left) = rest.split_at_checked(count)?;
            rest = left;
            Some(taken)
        };
        let own = take(6)?.try_into().ok()?;
        let count = whole(take(1)?[0])?;
        let mut blocks =
            (0..=count).map(|_| take(OF_STRETCH).and_then(Stretch::parse)).collect::<Option<Vec<Stretch>>>()?;
        let block = blocks.pop()?;
        let times = whole(take(1)?[0])? as u32;
        let count = whole(take(1)?[0])?;
        let reference = match count {
            0 => None,
            count => {
                let [time, pedestrian] = take(2)?.try_into().ok()?;
                let (gaps, speeds) = (take(count)?.to_vec(), take(count)?.to_vec());
                Some(Reference { time, gaps, speeds, pedestrian: whole(pedestrian).filter(|n| *n < count)? })
            }
        };
        let verdict = match *rest {
            [] => None,
            [class, decision, time, backward, least_gap, least_speed, std, distance, ref waves @ ..]
                if [0, 2].contains(&waves.len()) =>
            {
                Some(Verdict {
                    class: *Class::ALL.get(whole(class)?)?,
                    time,
                    decision: KEPT.get(whole(decision)?)?.clone(),
                    backward_flow: backward == 1.0,
                    least_gap,
                    least_speed,
                    std,
                    lasting_least_speed: waves.get(1).copied(),
                    wave_speed: waves.first().copied(),
                    distance,
                })
            }
            _ => return None,
        };
        Some(Memory { numbers: own, blocks, block, repeats: Repeats { reference, times }, verdict })
    }
}

/// What can have decided before the end of a run.
const KEPT: [Decision; 6] = [
    Decision::Start,
    Decision::EventKind,
    Decision::Return,
    Decision::Falling,
    Decision::Repetition,
    Decision::Windows,
];

/// A number that counts something.
fn whole(number: f64) -> Option<usize> {
    let is_count = number.fract() == 0.0 && (0.0..1e15).contains(&number);
    is_count.then_some(number as usize)
}
