//! Is the grid tracer's picture the naive one of the same form, bit for bit, on the whole scene matrix?

use contract::{Image, MISS};
use optimized::Form;
use rayon::prelude::*;
use reference::Arithmetic;
use std::io::Write;
use verify::matrix::{Case, Matrix};

const FORMS: [(Form, Arithmetic); 2] =
    [(Form::Textbook, Arithmetic::F32Textbook), (Form::Perpendicular, Arithmetic::F32Perpendicular)];

#[test]
fn the_grid_changes_nothing() {
    let matrix = Matrix::new().expect("all data that is there can be read");
    for name in &matrix.absent {
        // Past the capture of output: who runs the tests must see it.
        _ = writeln!(std::io::stderr(), "not judged: {name}: data absent (run tests/fetch-data)");
    }
    let hits: u64 =
        matrix.cases.par_iter().map(|case| FORMS.map(|form| judge(case, form)).iter().sum::<u64>()).sum();
    eprintln!("{} pictures in 2 forms, {hits} hits", matrix.cases.len());
    assert!(matrix.cases.len() > 250 && hits > 300_000, "too little was at stake");
}

fn judge(case: &Case, (form, arithmetic): (Form, Arithmetic)) -> u64 {
    let naive =
        reference::Tracer::new(arithmetic).threads(1).render(&case.scene, &case.camera).expect("small").image;
    let grid = optimized::Tracer::new(form).workers(2).render(&case.scene, &case.camera).expect("small");
    for i in 0..naive.ids.len() {
        let pixel = |image: &Image| (image.ids[i], image.t[i].to_bits(), image.rgba[i]);
        assert_eq!(
            pixel(&naive),
            pixel(&grid),
            "naive, grid; {form:?}, {}, pixel {i} of {:?}",
            case.name,
            naive.size
        );
    }
    naive.ids.iter().filter(|&&id| id != MISS).count() as u64
}
