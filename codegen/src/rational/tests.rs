//! Every operation against numbers of any length, with words drawn most densely where they overflow.

use std::collections::hash_map::DefaultHasher;

use num_traits::Pow;
use proptest::prelude::*;

use super::*;

/// Powers of two and numbers near them, near √2⁶³ and 2⁶³, and small ones: where sums, products and cross
/// products just fit or just do not.
fn word() -> impl Strategy<Value = i128> {
    let near = |bits: std::ops::RangeInclusive<u32>| {
        (bits, -3_i128..=3).prop_map(|(bits, off)| (1 << bits) + off)
    };
    let size = prop_oneof![
        4 => 0_i128..=20,
        2 => (0_u32..=17).prop_map(|ten| 10_i128.pow(ten)),
        2 => near(2..=66),
        2 => near(30..=33),
        2 => near(62..=64),
        1 => any::<i64>().prop_map(i128::from),
        1 => (any::<i32>(), any::<i32>()).prop_map(|(a, b)| i128::from(a) * i128::from(b)),
    ];
    (size, any::<bool>()).prop_map(|(size, minus)| if minus { -size } else { size })
}

/// The same number in both forms.
fn number() -> impl Strategy<Value = (Rational, BigRational)> {
    (word(), word().prop_filter("a denominator", |d| *d != 0)).prop_map(|(n, d)| {
        let (n, d) = (BigInt::from(n), BigInt::from(d));
        (Rational::new(n.clone(), d.clone()), BigRational::new(n, d))
    })
}

/// Equal in value, in lowest terms, in words exactly if it fits, and found equal however it was made.
fn check(found: &Rational, exact: &BigRational) -> Result<(), TestCaseError> {
    prop_assert_eq!(&found.numer(), exact.numer());
    prop_assert_eq!(&found.denom(), exact.denom());
    let largest = BigInt::from(i64::MAX);
    let fits = exact.numer().magnitude() <= largest.magnitude() && *exact.denom() <= largest;
    prop_assert_eq!(matches!(found.0, Kept::Small(_)), fits);
    let again = Rational::new(exact.numer().clone(), exact.denom().clone());
    prop_assert_eq!(found, &again);
    prop_assert_eq!(hash(found), hash(&again));
    prop_assert_eq!(found.cmp(&again), Ordering::Equal);
    Ok(())
}

fn hash(value: &Rational) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbers_are_the_same_however_kept((x, exact) in number()) {
        check(&x, &exact)?;
        check(&-&x, &-&exact)?;
        check(&x.abs(), &exact.abs())?;
        check(&x.signum(), &exact.signum())?;
        check(&x.floor(), &exact.floor())?;
        if !exact.is_zero() {
            check(&x.recip(), &exact.recip())?;
        }
        prop_assert_eq!(x.to_integer(), exact.to_integer());
        prop_assert_eq!(x.to_i64(), exact.to_i64());
        prop_assert_eq!(x.to_u64(), exact.to_u64());
        prop_assert_eq!(x.to_i32(), exact.to_i32());
        prop_assert_eq!(x.is_integer(), exact.is_integer());
        prop_assert_eq!(x.is_over(2), *exact.denom() == 2.into());
        prop_assert_eq!(x.bits(), exact.numer().bits().max(exact.denom().bits()));
        prop_assert_eq!((x.is_zero(), x.is_one()), (exact.is_zero(), exact.is_one()));
        prop_assert_eq!(x.is_positive(), exact.is_positive());
        prop_assert_eq!(x.is_negative(), exact.is_negative());
        prop_assert_eq!(x.to_string(), exact.to_string());
        check(&Rational::from_str_radix(&exact.to_string(), 10).expect("a number"), &exact)?;
    }

    #[test]
    fn operations_are_exact((x, a) in number(), (y, b) in number()) {
        check(&(&x + &y), &(&a + &b))?;
        check(&(&x - &y), &(&a - &b))?;
        check(&(&x * &y), &(&a * &b))?;
        // What falls back into words after it left them.
        check(&(&(&x * &y) - &(&x * &y)), &BigRational::zero())?;
        check(&(&(&x + &y) - &y), &a)?;
        if !b.is_zero() {
            check(&(&x / &y), &(&a / &b))?;
            check(&(&x % &y), &(&a % &b))?;
            check(&(&(&x * &y) / &y), &a)?;
        }
        let mut sum = x.clone();
        sum += &y;
        sum -= x.clone();
        sum *= Rational::from(3);
        sum /= Rational::from(3);
        check(&sum, &b)?;
        prop_assert_eq!(x.cmp(&y), a.cmp(&b));
        prop_assert_eq!((&x * &y).cmp(&x), (&a * &b).cmp(&a));
        prop_assert_eq!(x == y, a == b);
        check(&[x.clone(), y.clone(), x.clone()].into_iter().sum(), &(&a + &b + &a))?;
        check(&[x.clone(), y, x].into_iter().product(), &(&a * &b * &a))?;
    }

    #[test]
    fn powers_and_roots_are_exact((x, exact) in number(), exponent in -70_i32..=70) {
        if !exact.is_zero() {
            let power: BigRational = Pow::pow(exact.clone(), exponent);
            check(&x.pow(exponent), &power)?;
        }
        check(&x.abs().pow(2).root().expect("a square"), &exact.abs())?;
        let root = x.root();
        let whole = |n: &BigInt| !n.is_negative() && n.sqrt().pow(2_u32) == *n;
        prop_assert_eq!(root.is_some(), whole(exact.numer()) && whole(exact.denom()));
        if let Some(root) = root {
            prop_assert_eq!(&root * &root, x);
        }
    }

    /// No neighbour of the f64 is nearer, and of two as near it is the even one.
    #[test]
    fn the_f64_is_the_nearest((x, exact) in number(), (y, _) in number()) {
        for (x, exact) in [(x.clone(), exact.clone()), (&x * &y, (&x * &y).large().into_owned())] {
            let found = nearest(&x);
            prop_assert_eq!(found.to_bits(), exact.to_f64().expect("a number").to_bits());
            let far = |value: f64| (BigRational::from_float(value).expect("finite") - &exact).abs();
            for neighbour in [found.next_up(), found.next_down()] {
                prop_assert!(far(found) <= far(neighbour));
                prop_assert!(far(found) < far(neighbour) || found.to_bits().is_multiple_of(2));
            }
        }
    }

    #[test]
    fn an_f64_is_read_exactly(value in any::<f64>(), near in -1e3..1e3) {
        for value in [value, near, near.trunc(), near.trunc() / 1024.0] {
            let exact = BigRational::from_float(value);
            prop_assert_eq!(Rational::from_float(value).is_some(), exact.is_some());
            if let (Some(found), Some(exact)) = (Rational::from_float(value), exact) {
                check(&found, &exact)?;
                prop_assert_eq!(nearest(&found), value);
            }
        }
    }

    #[test]
    fn decimals_are_read_exactly(
        whole in 0_u64.., digits in 0_usize..=25, fraction in any::<u128>(), ten in -40_i32..=40,
    ) {
        let fraction = &format!("{fraction:039}")[..digits];
        let point = if digits == 0 { "" } else { "." };
        let (value, length) = crate::units::decimal(&format!("{whole}{point}{fraction}e{ten}mm"))
            .expect("a number");
        prop_assert!(length > digits);
        let mantissa: BigInt = format!("{whole}{fraction}").parse().expect("digits");
        let power: BigRational =
            Pow::pow(BigRational::from_integer(10.into()), ten - digits as i32);
        check(&value.expect("within the limits"), &(BigRational::from_integer(mantissa) * power))?;
    }
}

#[test]
fn words_at_their_ends_keep_their_sign() {
    let least = Rational::from(i64::MIN);
    let most = Rational::from(i64::MAX);
    assert_eq!(-&least, &most + &Rational::one());
    assert_eq!(least.abs() - Rational::one(), most);
    assert_eq!(&least + &Rational::one(), -&most);
    assert!(matches!((&least + &Rational::one()).0, Kept::Small(_)));
    assert_eq!(Rational::new(1, i64::MIN).recip(), least);
    assert_eq!(Rational::from(u64::MAX) / Rational::from(u64::MAX), Rational::one());
    assert_eq!(size_of::<Rational>(), 16);
}
