//! Numbers as text, for sentences and tables.

/// How many decimals show differences of a hundredth of the range of `values`; at most 6.
pub(super) fn decimals(values: impl IntoIterator<Item = f64>) -> usize {
    let (low, high) = values
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (value.min(low), value.max(high)));
    let mut hundredth = (high - low) / 100.0;
    let mut decimals = 0;
    // Without a range two decimals are enough.
    if hundredth.is_nan() || hundredth <= 0.0 {
        return 2;
    }
    while hundredth < 0.5 && decimals < 6 {
        hundredth *= 10.0;
        decimals += 1;
    }
    decimals
}

/// With so many decimals and a true minus sign, `−0` excepted.
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    if value < 0.0 && text.contains(|digit| ('1'..='9').contains(&digit)) { format!("−{text}") } else { text }
}

/// A whole number with its thousands apart: `20,000`.
pub(super) fn count(value: f64) -> String {
    let digits = number(value.abs(), 0);
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A p value: two decimals, four where it matters.
pub(super) fn p_value(p: f64) -> String {
    if p < 0.0001 { "< 0.0001".into() } else { number(p, if p < 0.1 { 4 } else { 2 }) }
}

/// `1 seed`, `2 seeds`.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// `a, b and c`.
pub(super) fn listed<Text: AsRef<str>>(words: &[Text]) -> String {
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    match words.split_last() {
        None => String::new(),
        Some((only, [])) => (*only).into(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(
            [count(0.0), count(999.0), count(20_000.0), count(1_234_567.0)],
            ["0", "999", "20,000", "1,234,567"]
        );
        assert_eq!([number(-1.25, 1), number(-0.04, 1), number(2.0, 2)], ["−1.2", "0.0", "2.00"]);
        assert_eq!([0.5, 0.0625, 0.00001].map(p_value), ["0.50", "0.0625", "< 0.0001"]);
        assert_eq!([listed::<&str>(&[]), listed(&["a"]), listed(&["a", "b", "c"])], ["", "a", "a, b and c"]);
        assert_eq!([counted(1, "seed", "seeds"), counted(2, "seed", "seeds")], ["1 seed", "2 seeds"]);
    }

    #[test]
    fn decimals_follow_the_range() {
        assert_eq!([decimals([0.0, 10.0]), decimals([0.0, 1000.0]), decimals([0.5, 0.51])], [1, 0, 4]);
        assert_eq!([decimals([3.0, 3.0]), decimals([])], [2, 2]);
    }
}
