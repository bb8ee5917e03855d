use ne_core::archive::{self, Layout};
use proptest::prelude::*;
use std::path::Path;

/// Numbers as they come back from a file.
fn there_and_back(path: &Path, small: &[f32], large: &[f64], whole: &[u64]) -> (Vec<f32>, Vec<f64>, Vec<u64>) {
    archive::write(path, "numbers", 1, &(small, large, whole), Layout::Compact).expect("a writable folder");
    archive::read(path, "numbers", 1).expect("what was written")
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn every_finite_number_comes_back_to_the_bit(
        small in prop::collection::vec(any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |x| x.is_finite()), 1000),
        large in prop::collection::vec(any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()), 300),
        whole in prop::collection::vec(any::<u64>(), 20),
    ) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let found = there_and_back(&folder.path().join("file"), &small, &large, &whole);
        prop_assert_eq!(bits(&found.0), bits(&small));
        prop_assert_eq!(found.1.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), large.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
        prop_assert_eq!(found.2, whole);
    }
}

/// 7.038531e-26 is the only f32 whose shortest decimal, rounded to f64 and then to f32, is another f32 (all were tried).
#[test]
fn the_numbers_that_are_hard_to_round_come_back() {
    let hard = f32::from_bits(0x15ae_43fd);
    assert_ne!(hard.to_string().parse::<f64>().expect("a number") as f32, hard, "rounded twice");
    let small = [hard, -hard, f32::MIN_POSITIVE, f32::from_bits(1), -f32::from_bits(1), f32::MAX, f32::MIN, 0.0, -0.0];
    let large = [f64::MAX, f64::MIN_POSITIVE, f64::from_bits(1), -0.0, 0.1 + 0.2];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let found = there_and_back(&folder.path().join("file"), &small, &large, &[0, u64::MAX]);
    assert_eq!(bits(&found.0), bits(&small));
    assert_eq!(found.1, large);
    assert!(found.1[3].is_sign_negative());
}
