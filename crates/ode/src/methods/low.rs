//! Pairs of orders 3 and 5 whose last stage is the right-hand side at the end of the step.

#![allow(clippy::excessive_precision, reason = "the digits as published, to be compared one by one")]

use crate::tableau::{Interpolant, Tableau};

/// Order 3, estimate of order 2, cubic interpolant of order 3.
///
/// P. Bogacki, L. F. Shampine, *A 3(2) pair of Runge-Kutta formulas*, Applied Mathematics Letters 2 (1989) 321.
pub static BS32: Tableau = Tableau {
    name: "bs32",
    order: 3,
    rows: &[&[(0, 0.5)], &[(1, 0.75)]],
    weights: &[(0, 2.0 / 9.0), (1, 1.0 / 3.0), (2, 4.0 / 9.0)],
    errors: &[&[(0, -5.0 / 72.0), (1, 1.0 / 12.0), (2, 1.0 / 9.0), (3, -1.0 / 8.0)]],
    interpolant: Interpolant::Cubic,
};

/// Order 5, estimate of order 4, interpolant of order 4 without a further stage.
///
/// J. R. Dormand, P. J. Prince, *A family of embedded Runge-Kutta formulae*, J. Comput. Appl. Math. 6 (1980) 19;
/// the interpolant is that of the program DOPRI5 of Hairer, Norsett and Wanner.
pub static DOPRI54: Tableau = Tableau {
    name: "dopri54",
    order: 5,
    rows: &[
        &[(0, 0.2)],
        &[(0, 3.0 / 40.0), (1, 9.0 / 40.0)],
        &[(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)],
        &[(0, 19372.0 / 6561.0), (1, -25360.0 / 2187.0), (2, 64448.0 / 6561.0), (3, -212.0 / 729.0)],
        &[(0, 9017.0 / 3168.0), (1, -355.0 / 33.0), (2, 46732.0 / 5247.0), (3, 49.0 / 176.0), (4, -5103.0 / 18656.0)],
    ],
    weights: &[(0, 35.0 / 384.0), (2, 500.0 / 1113.0), (3, 125.0 / 192.0), (4, -2187.0 / 6784.0), (5, 11.0 / 84.0)],
    errors: &[&[
        (0, 71.0 / 57600.0),
        (2, -71.0 / 16695.0),
        (3, 71.0 / 1920.0),
        (4, -17253.0 / 339200.0),
        (5, 22.0 / 525.0),
        (6, -1.0 / 40.0),
    ]],
    interpolant: Interpolant::Nested {
        stages: &[],
        rows: &[&[
            (0, -12715105075.0 / 11282082432.0),
            (2, 87487479700.0 / 32700410799.0),
            (3, -10690763975.0 / 1880347072.0),
            (4, 701980252875.0 / 199316789632.0),
            (5, -1453857185.0 / 822651844.0),
            (6, 69997945.0 / 29380423.0),
        ]],
    },
};

/// Order 5, estimate of order 4, interpolant of order 4 without a further stage.
///
/// Ch. Tsitouras, *Runge-Kutta pairs of order 5(4) satisfying only the first column simplifying assumption*,
/// Computers & Mathematics with Applications 62 (2011) 770. Of the published interpolant, whose weights are of degree 4
/// and meet rates and states at both ends, the coefficients of `theta^4` are all that the cubic lacks.
pub static TSIT54: Tableau = Tableau {
    name: "tsit54",
    order: 5,
    rows: &[
        &[(0, 0.161)],
        &[(0, -0.00848065549235698854442687425023), (1, 0.335480655492356988544426874250)],
        &[
            (0, 2.89715305710549343213043259419),
            (1, -6.35944848997507484314815991238),
            (2, 4.36229543286958141101772731819),
        ],
        &[
            (0, 5.32586482843925660442887792084),
            (1, -11.7488835640628278777471703398),
            (2, 7.49553934288983620830460478456),
            (3, -0.0924950663617552492565020793321),
        ],
        &[
            (0, 5.86145544294642002865925148698),
            (1, -12.9209693178471092917061186818),
            (2, 8.15936789857615864318040079454),
            (3, -0.0715849732814009972245305425258),
            (4, -0.0282690503940683829090030572127),
        ],
    ],
    weights: &[
        (0, 0.0964607668180652295181673131651),
        (1, 0.01),
        (2, 0.479889650414499574775249532291),
        (3, 1.37900857410374189319227482186),
        (4, -3.29006951543608067990104758571),
        (5, 2.3247105240997739824153559184),
    ],
    errors: &[&[
        (0, -0.00178001105222577714),
        (1, -0.0008164344596567469),
        (2, 0.007880878010261995),
        (3, -0.1447110071732629),
        (4, 0.5823571654525552),
        (5, -0.45808210592918697),
        (6, 1.0 / 66.0),
    ]],
    interpolant: Interpolant::Nested {
        stages: &[],
        rows: &[&[
            (0, -1.0530884977290216),
            (1, 0.1017),
            (2, 2.490627285651252793),
            (3, -16.54810288924490272),
            (4, 47.37952196281928122),
            (5, -34.87065786149660974),
            (6, 2.5),
        ]],
    },
};
