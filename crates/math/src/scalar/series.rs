//! Power series in double-double numbers, and their coefficients (printed by `coefficients.py`).

use crate::double_double::DoubleDouble;

/// The sum of c_n z^n over n, for |z| < 1 and coefficients of which none is smaller
/// than the sum of all later terms. Terms from z^`precise` on are summed in doubles:
/// there the caller knows them to be too small for the rest of the digits to matter.
#[inline(always)]
pub(super) fn sum(coefficients: &[DoubleDouble], precise: usize, z: DoubleDouble) -> DoubleDouble {
    let (leading, trailing) = coefficients.split_at(precise);
    let tail = trailing.iter().rev().fold(0.0, |tail, c| tail * z.hi + c.hi);
    leading.iter().rev().fold(DoubleDouble::from(tail), |sum, c| {
        let product = DoubleDouble::product(sum.hi, z.hi);
        let crossed = sum.hi * z.lo + sum.lo * z.hi;
        let total = DoubleDouble::ordered_sum(c.hi, product.hi);
        DoubleDouble { hi: total.hi, lo: total.lo + (product.lo + (crossed + c.lo)) }
    })
}

/// Every second entry of a table from `start` on, with alternating signs if asked.
pub(super) const fn every_second<const N: usize>(start: usize) -> [DoubleDouble; N] {
    let mut chosen = [DoubleDouble::ZERO; N];
    let mut n = 0;
    while n < N {
        let DoubleDouble { hi, lo } = INVERSE_FACTORIALS[start + 2 * n];
        chosen[n] = if n % 2 == 0 { pair(hi, lo) } else { pair(-hi, -lo) };
        n += 1;
    }
    chosen
}

const fn pair(hi: f64, lo: f64) -> DoubleDouble {
    DoubleDouble { hi, lo }
}

/// 1 / n!
#[rustfmt::skip]
pub(crate) const INVERSE_FACTORIALS: [DoubleDouble; 26] = [
    pair(1.0, 0.0),
    pair(1.0, 0.0),
    pair(0.5, 0.0),
    pair(0.16666666666666666, 9.25185853854297e-18),
    pair(0.041666666666666664, 2.3129646346357427e-18),
    pair(0.008333333333333333, 1.1564823173178714e-19),
    pair(0.001388888888888889, -5.300543954373577e-20),
    pair(0.0001984126984126984, 1.7209558293420705e-22),
    pair(2.48015873015873e-05, 2.1511947866775882e-23),
    pair(2.7557319223985893e-06, -1.858393274046472e-22),
    pair(2.755731922398589e-07, 2.3767714622250297e-23),
    pair(2.505210838544172e-08, -1.448814070935912e-24),
    pair(2.08767569878681e-09, -1.20734505911326e-25),
    pair(1.6059043836821613e-10, 1.2585294588752098e-26),
    pair(1.1470745597729725e-11, 2.0655512752830745e-28),
    pair(7.647163731819816e-13, 7.03872877733453e-30),
    pair(4.779477332387385e-14, 4.399205485834081e-31),
    pair(2.8114572543455206e-15, 1.6508842730861433e-31),
    pair(1.5619206968586225e-16, 1.1910679660273754e-32),
    pair(8.22063524662433e-18, 2.2141894119604265e-34),
    pair(4.110317623312165e-19, 1.4412973378659527e-36),
    pair(1.9572941063391263e-20, -1.3643503830087908e-36),
    pair(8.896791392450574e-22, -7.911402614872376e-38),
    pair(3.868170170630684e-23, -8.843177655482344e-40),
    pair(1.6117375710961184e-24, -3.6846573564509766e-41),
    pair(6.446950284384474e-26, -1.9330404233703465e-42),
];

/// 2 / (2n + 1)
#[rustfmt::skip]
pub(super) const ODD_INVERSES: [DoubleDouble; 18] = [
    pair(2.0, 0.0),
    pair(0.6666666666666666, 3.700743415417188e-17),
    pair(0.4, -2.2204460492503132e-17),
    pair(0.2857142857142857, 1.586032892321652e-17),
    pair(0.2222222222222222, 1.2335811384723961e-17),
    pair(0.18181818181818182, -5.046468293750712e-18),
    pair(0.15384615384615385, -8.540177112501205e-18),
    pair(0.13333333333333333, 1.8503717077085942e-18),
    pair(0.11764705882352941, 1.6326809185664067e-18),
    pair(0.10526315789473684, 5.843279076974508e-18),
    pair(0.09523809523809523, 5.28677630773884e-18),
    pair(0.08695652173913043, 2.413528314402514e-18),
    pair(0.08, -1.6653345369377347e-18),
    pair(0.07407407407407407, 4.11193712824132e-18),
    pair(0.06896551724137931, 9.570888143320315e-19),
    pair(0.06451612903225806, 1.7906822977825105e-18),
    pair(0.06060606060606061, -1.6821560979169039e-18),
    pair(0.05714285714285714, 1.7842870038618585e-18),
];
