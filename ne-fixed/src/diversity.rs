use crate::WeightVector;

/// The standard deviation of a gene over the individuals, mean of all genes; 0 without individuals.
pub(crate) fn diversity(individuals: &[WeightVector]) -> f64 {
    let Some(reference) = individuals.first() else { return 0.0 };
    let (count, genes) = (individuals.len() as f64, reference.weights().len());
    let (mut sums, mut squares) = (vec![0.0; genes], vec![0.0; genes]);
    for individual in individuals {
        for (gene, (weight, origin)) in individual.weights().iter().zip(reference.weights()).enumerate() {
            // Differences, since squares of a common large offset would swamp the deviation.
            let difference = f64::from(weight - origin);
            sums[gene] += difference;
            squares[gene] += difference * difference;
        }
    }
    let variance = |(sum, square): (&f64, &f64)| ((square - sum * sum / count) / count).max(0.0);
    sums.iter().zip(&squares).map(|sums| variance(sums).sqrt()).sum::<f64>() / genes as f64
}
