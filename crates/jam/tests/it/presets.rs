//! The presets are the rows of tab:model.

use jam::laws::presets::PRESETS;

#[test]
fn presets_are_those_of_the_table() {
    let rows: Vec<_> = PRESETS.iter().map(|p| (p.name, p.mu, p.delta, p.q, p.a_v)).collect();
    let table = [
        ("CFM", Some(0.0), 1.0, 1.0, Some(0.0)),
        ("GCFM", None, 1.0, 1.0, None),
        ("HFV", None, 0.0, 2.0, Some(0.0)),
        ("SEY", None, 0.0, 2.0, None),
        ("GUO", None, 0.0, 1.0, Some(0.0)),
    ];
    assert_eq!(rows, table);
}

#[test]
fn open_parameters_are_taken_and_fixed_ones_kept() {
    for preset in PRESETS {
        let law = preset.law(0.7, 0.3, 0.2, 1.5);
        assert_eq!(law.mu, preset.mu.unwrap_or(0.7));
        assert_eq!(law.a_v, preset.a_v.unwrap_or(0.3));
        assert_eq!((law.delta, law.q), (preset.delta, preset.q));
        assert_eq!((law.epsilon, law.v0), (0.2, 1.5));
    }
}

#[test]
fn the_force_of_cfm_comes_from_the_ramp_alone() {
    let law = PRESETS[0].law(0.0, 0.0, 0.1, 3.0);
    assert!((law.gamma() - 0.1 * std::f64::consts::LN_2).abs() < 1e-17);
}
