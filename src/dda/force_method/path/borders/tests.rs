use super::*;
use crate::dda::factor::tests::numbers;
use pulp::Scalar;

#[test]
fn the_first_function_that_falls_to_nought_is_the_next() {
    // The last group has fewer than the others.
    const INTERFACES: usize = 99;
    let mut number = numbers();
    let mut linear = || -> Linear { std::array::from_fn(|_| number.next().unwrap()) };
    for _ in 0..100 {
        let mut functions: Vec<[Linear; 4]> = (0..INTERFACES).map(|_| std::array::from_fn(|_| linear())).collect();
        let ([x, y, z, _, l], [dx, dy, dz, _, dl]) = (linear(), linear());
        let (here, rate) = ([x, y, z, 1.0, l], [dx, dy, dz, 0.0, dl]);
        let at = |of: &Linear, way: &Linear| (0..5).map(|c| of[c] * way[c]).sum::<f64>();
        // All are positive to begin with, some never change, and some only rise.
        for of in functions.iter_mut().flatten() {
            of[3] += at(of, &here).abs() - at(of, &here);
        }
        functions[7] = [[0.0, 0.0, 0.0, 1.0, 0.0]; 4];
        let mut borders = Borders::new(INTERFACES);
        for (k, four) in functions.iter().enumerate() {
            *borders.of(k) = std::array::from_fn(|c| four.each_ref().map(|of| of[c]));
        }
        let falls =
            functions.iter().enumerate().flat_map(|(k, four)| (0..4).map(move |which| (k, which, &four[which])));
        let falls = falls.filter(|(.., of)| at(of, &rate) < 0.0);
        let steps = falls.map(|(k, which, of)| (at(of, &here) / -at(of, &rate), k, which));
        let (step, interface, which) = steps.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        let next = borders.next(&here, &rate).unwrap();
        for last in 0..INTERFACES {
            let search = || Search { functions: &borders.functions, last, here: &here, rate: &rate };
            assert_eq!(search().with_simd(Scalar), Some(next), "beside {last}");
            assert_eq!(Arch::new().dispatch(search()), Some(next), "beside {last}");
        }
        assert_eq!((next.interface, next.which), (interface, which));
        assert!((next.step - step).abs() <= 1e-9 * step, "{next:?} {step}");
        assert_eq!(borders.next(&here, &[0.0; 5]), None);
    }
}
