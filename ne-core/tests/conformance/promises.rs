use ne_core::conformance::{Promise, genome, phenotype, selector, strategy, task};

const HONEST: Promise = Promise::new("politician", "the truth");

#[test]
fn a_violation_reads_well() {
    let violation = HONEST.broken("42 lies");
    assert_eq!(violation.to_string(), "a politician owes: the truth. Found: 42 lies");
    assert_eq!((HONEST.contract(), HONEST.text()), ("politician", "the truth"));
}

#[test]
fn a_check_gives_its_value_its_finding_or_its_panic() {
    assert_eq!(HONEST.check(|| Ok(3)), Ok(3));
    assert_eq!(HONEST.check(|| Err::<(), _>("a lie".into())), Err(HONEST.broken("a lie")));
    assert_eq!(HONEST.check(|| -> Result<(), String> { panic!("caught") }), Err(HONEST.broken("it panicked: caught")));
    let formatted = HONEST.check(|| -> Result<(), String> { panic!("caught {}", 2) });
    assert_eq!(formatted, Err(HONEST.broken("it panicked: caught 2")));
}

#[test]
fn no_promise_is_made_twice() {
    let all = [genome::PROMISES, phenotype::PROMISES, selector::PROMISES, strategy::PROMISES, task::PROMISES].concat();
    for (index, promise) in all.iter().enumerate() {
        assert!(!all[..index].contains(promise), "{promise:?}");
    }
}
