//! Claim: the bound of the f32 stage follows from the steps that stand in [`optimized::bound`], for every unit roundoff u below 1/8.
//!
//! Each lemma is one inequality of that text, over the reals and with its names; from one to the next it is substitution, and P, R, x, ρ, K,
//! β, κ, η, τ and the two thresholds are those of the text. How k roundings add up, what two products are off by, and that a product of vectors
//! is at most that of their lengths, is proved with the f64 stage: `rounding.more`, `rounding.root.1`, `rounding.root.2.cauchy`. That the roots
//! are h ± √D / a is `find.root`, about the shipped kernel.
//!
//! *What is no inequality of real numbers:* how many roundings a term of the kernel meets, read off the source; that a slope's
//! one is at most u/2, by the spacing of floats below 1; what underflows, by the range of the inputs; and that [`optimized::bound::Rule`]
//! rounds its coefficients up. All inputs of floats of 8 bits go through the same source in `tests/bound.rs`.

use super::real::{HALF, ONE, QUARTER, Real, Reals, SIXTEENTH, SMALL, TWO, ZERO, follows, lemma, step};
use crate::prove::theorem::{Ask, Lemma, Statement};
use optimized::machine::Machine;

/// (1 + u)ᵏ − 1.
fn gamma<M: Machine>(u: Real<M>, k: u32) -> Real<M> {
    (1.0 + u).power(k) - 1.0
}

fn square<M: Machine>([x, y, z]: [Real<M>; 3]) -> Real<M> {
    x * x + y * y + z * z
}

/// (v_Y z − v_Z y, v_Y, v_Z), of v and s.
fn map<M: Machine>([v, w]: [Real<M>; 2], [y, z]: [Real<M>; 2]) -> [Real<M>; 3] {
    [v * z - w * y, v, w]
}

/// 1 + y² + z².
fn length<M: Machine>([y, z]: [Real<M>; 2]) -> Real<M> {
    1.0 + y * y + z * z
}

fn cross<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, b, c] = r.each(["c A", "c Y", "c Z"]);
    let s = r.each(["y", "z"]);
    let [y, z] = s;
    let e = map([b - y * a, c - z * a], s);
    follows(
        vec![],
        vec![],
        vec![
            ("e X is the cross product's", e[0].equals(b * z - c * y)),
            ("|e|² is a |c|² less the square of c's product with the ray", {
                square(e).equals(length(s) * square([a, b, c]) - (a + y * b + z * c).square())
            }),
        ],
    )
}

/// One component's error, by what it is of e and of c A. ζ is the slope's error.
struct Component<M: Machine> {
    y: Real<M>,
    slope: Real<M>,
    zeta: Real<M>,
    delta: [Real<M>; 4],
}

impl<M: Machine> Component<M> {
    fn ask(r: &mut Reals<'_, M, impl Ask<M>>) -> Self {
        let [y, zeta] = r.each(["y", "ζ"]);
        Self { y, slope: y + zeta, zeta, delta: r.each(["δ1", "δ2", "δ3", "δ4"]) }
    }
    /// Of e.
    fn own(&self) -> Real<M> {
        let [of_c, _, _, last] = self.delta;
        (1.0 + of_c) * (1.0 + last) - 1.0
    }
    /// Of c A.
    fn rest(&self) -> Real<M> {
        let [of_c, of_a, product, last] = self.delta;
        let inner = self.y * of_c - self.zeta * (1.0 + of_a) - self.slope * (1.0 + of_a) * product;
        (1.0 + last) * inner - self.y * of_a * last
    }
}

fn split<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, c] = r.each(["c A", "c Y"]);
    let parts = Component::ask(r);
    let [of_c, of_a, product, last] = parts.delta;
    let e = c - parts.y * a;
    let computed = (c * (1.0 + of_c) - parts.slope * (a * (1.0 + of_a)) * (1.0 + product)) * (1.0 + last);
    let eta = -(a * of_a);
    follows(
        vec![],
        vec![],
        vec![("the error is η y, a part of e and a part of c A", {
            (computed - e).equals(eta * parts.y + e * parts.own() + a * parts.rest())
        })],
    )
}

fn own<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, first, last] = r.each(["u", "δ1", "δ4"]);
    follows(
        vec![("each rounding is within u", r.within([first, last], u))],
        vec![],
        vec![("both are within γ2", ((1.0 + first) * (1.0 + last) - 1.0).within(gamma(u, 2)))],
    )
}

/// K.
fn k<M: Machine>(u: Real<M>) -> Real<M> {
    (1.0 + u) * (u + (1.0 + u) * u / 2.0 + (1.0 + u) * u) + u * u
}

/// What the part of c A is made of.
fn parts<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let u = r.get("u");
    let parts = Component::ask(r);
    let [of_c, of_a, product, last] = parts.delta;
    let one = r.number(1.0);
    let inner = parts.y * of_c - parts.zeta * (1.0 + of_a) - parts.slope * (1.0 + of_a) * product;
    let sum = u + (1.0 + u) * u / 2.0 + (1.0 + u) * u;
    follows(
        vec![
            ("each rounding is within u", r.within(parts.delta, u)),
            ("the slope's is within u/2", parts.zeta.within(u / 2.0)),
            ("slopes are at most 1, true", parts.y.within(one)),
            ("and computed", parts.slope.within(one)),
        ],
        vec![
            ("u is not negative", r.not_negative([u])),
            ("c Y's part", (parts.y * of_c).within(u)),
            ("1 + δ", (1.0 + of_a).within(1.0 + u)),
            ("the slope's part", (parts.zeta * (1.0 + of_a)).within((1.0 + u) * u / 2.0)),
            ("the slope and 1 + δ", (parts.slope * (1.0 + of_a)).within(1.0 + u)),
            ("the product's part", (parts.slope * (1.0 + of_a) * product).within((1.0 + u) * u)),
            ("the parts together", inner.within(sum)),
            ("y and a rounding", (parts.y * of_a).within(u)),
            ("and two", (parts.y * of_a * last).within(u * u)),
        ],
        vec![
            ("before the last rounding it is within that", inner.within(sum)),
            ("and of c A's and the last within u²", (parts.y * of_a * last).within(u * u)),
        ],
    )
}

fn rest<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, before, last, both] = r.each(["u", "before", "δ4", "both"]);
    let sum = u + (1.0 + u) * u / 2.0 + (1.0 + u) * u;
    follows(
        vec![
            ("before the last rounding it is within that", before.within(sum)),
            ("the last is within u", last.within(u)),
            ("c A's and the last within u²", both.within(u * u)),
        ],
        vec![("the last adds u of it", ((1.0 + last) * before).within((1.0 + u) * sum))],
        vec![("the part of c A is within K", ((1.0 + last) * before - both).within(k(u)))],
    )
}

fn component<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [e, a, g, h] = r.each(["e Y", "c A", "own", "rest"]);
    let [two, k, m] = r.each(["γ2", "K", "m"]);
    follows(
        vec![
            ("the part of e is within γ2", g.within(two)),
            ("the part of c A is within K", h.within(k)),
            ("c A is at most m", a.within(m)),
        ],
        vec![
            ("of e it is γ2 |e Y|", (e * g).within(two * e.size())),
            ("of c A it is K m", (a * h).within(k * m)),
        ],
        vec![("α is at most γ2 |e Y| + K m", (e * g + a * h).within(two * e.size() + k * m))],
    )
}

fn mapped<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (alpha, s, eta) = (r.each(["α Y", "α Z"]), r.each(["y", "z"]), r.get("η"));
    let v = [alpha[0] + eta * s[0], alpha[1] + eta * s[1]];
    let product = alpha[0] * s[0] + alpha[1] * s[1];
    let a = length(s);
    follows(
        vec![],
        vec![],
        vec![
            ("the square is a |α|² + a η² − (α·s − η)²", {
                let size = alpha[0].square() + alpha[1].square();
                square(map(v, s)).equals(a * size + a * eta.square() - (product - eta).square())
            }),
            ("and e's own is at least that of Y and Z", {
                (alpha[0].square() + alpha[1].square()).at_most(square(map(alpha, s)))
            }),
        ],
    )
}

fn constant<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (alpha, s, eta) = (r.each(["α Y", "α Z"]), r.each(["y", "z"]), r.get("η"));
    let [km, um] = r.each(["K m", "u m"]);
    let size = alpha[0].square() + alpha[1].square() + eta.square();
    let three = r.number(3.0);
    follows(
        vec![
            ("slopes are at most 1", r.within(s, r.number(1.0))),
            ("α is at most K m", r.within(alpha, km)),
            ("η is at most u m", eta.within(um)),
        ],
        vec![
            ("a is at most 3", length(s).at_most(three)),
            ("α and η are at most that, squared", size.at_most(2.0 * km.square() + um.square())),
            ("a of them is at most 3 of them", (length(s) * size).at_most(3.0 * size)),
        ],
        vec![("a (|α|² + η²) is at most (6 K² + 3 u²) m²", {
            (length(s) * size).at_most(6.0 * km.square() + 3.0 * um.square())
        })],
    )
}

fn scaled<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (alpha, s, e) = (r.each(["α Y", "α Z"]), r.each(["y", "z"]), r.each(["e Y", "e Z"]));
    let two = r.get("γ2");
    let size = alpha[0].square() + alpha[1].square();
    let of_e = e[0].square() + e[1].square();
    follows(
        vec![
            ("slopes are at most 1", r.within(s, r.number(1.0))),
            ("α is at most γ2 of e", {
                r.all(&[alpha[0].within(two * e[0].size()), alpha[1].within(two * e[1].size())])
            }),
        ],
        vec![
            ("a is at most 3", length(s).at_most(r.number(3.0))),
            ("|α| is at most γ2 of it", size.at_most(two.square() * of_e)),
        ],
        vec![("a |α|² is at most 3 γ2² |e|²", {
            (length(s) * size).at_most(3.0 * two.square() * of_e)
        })],
    )
}

/// The products in e X, whose factors ê are off by γ2 of e and by k = (K + u) m; p and q are |e Y| and |e Z|.
fn products<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [p, q, y, z] = r.each(["|e Y|", "|e Z|", "|y|", "|z|"]);
    let [two, k, long] = r.each(["γ2", "k", "√(e Y² + e Z²)"]);
    let one = r.number(1.0);
    let sum = p * z + q * y;
    let most = r.number(2.0).root() * long;
    follows(
        vec![
            ("slopes are at most 1", r.all(&[r.not_negative([y, z]), y.at_most(one), z.at_most(one)])),
            ("γ2 and k are not negative", r.not_negative([two, k])),
            ("p and q have that length", {
                r.all(&[r.not_negative([p, q, long]), (p.square() + q.square()).equals(long.square())])
            }),
        ],
        vec![
            ("the products are at most the sum", sum.at_most(p + q)),
            ("whose square is at most twice that of the length", { (p + q).square().at_most(most.square()) }),
            ("and so they are at most √2 of the length", sum.at_most(most)),
        ],
        vec![("the computed are at most √2 (1 + γ2) of it, and 2 k", {
            ((p * (1.0 + two) + k) * z + (q * (1.0 + two) + k) * y).at_most((1.0 + two) * most + 2.0 * k)
        })],
    )
}

/// With k the product of the two.
fn triangle<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [one, other, k, sum] = r.each(["|x|", "|y|", "x·y", "|x + y|"]);
    follows(
        vec![
            ("lengths are not negative", r.not_negative([one, other])),
            ("a product of vectors is at most that of their lengths", k.within(one * other)),
            ("the sum's square is that of the two", {
                sum.square().equals(one.square() + 2.0 * k + other.square())
            }),
        ],
        vec![],
        vec![("the sum is no longer than both", sum.at_most(one + other))],
    )
}

fn a<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, w] = r.each(["u", "y² + z²"]);
    let (two, five) = (gamma(u, 2), gamma(u, 5));
    let beta = (two + 2.0 * five) / 3.0;
    follows(
        vec![
            ("u is in range", in_range(r, u)),
            ("y² + z² is at most 2", r.all(&[r.not_negative([w]), w.at_most(r.number(2.0))])),
        ],
        vec![],
        vec![
            ("γ2 + γ5 (y² + z²) is at most β a", (two + five * w).at_most(beta * (1.0 + w))),
            ("β is below 1", beta.below(r.number(1.0))),
            ("γ3 is at most 1", gamma(u, 3).at_most(r.number(1.0))),
        ],
    )
}

fn in_range<M: Machine>(r: &Reals<'_, M, impl Ask<M>>, u: Real<M>) -> M::B {
    r.all(&[r.number(0.0).below(u), u.below(r.ratio(1.0, 8.0))])
}

fn kappa<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, beta, b, first, second] = r.each(["u", "β", "of a", "δ1", "δ2"]);
    let two = (1.0 + first) * (1.0 + second);
    follows(
        vec![
            ("a is off by at most β", b.within(beta)),
            ("two more are within u", r.within([first, second], u)),
        ],
        vec![("which is γ2", (two - 1.0).within(gamma(u, 2)))],
        vec![("a r² is off by at most κ", {
            ((1.0 + b) * two - 1.0).within((1.0 + beta) * (1.0 + u).square() - 1.0)
        })],
    )
}

/// What is known where the sign of D is asked.
struct Sign<M: Machine> {
    /// a r².
    s: Real<M>,
    /// |e|.
    e: Real<M>,
    /// Before its rounding: what is computed of a r² less what is computed of |e|².
    z: Real<M>,
    kappa: Real<M>,
    gamma: Real<M>,
    rho: Real<M>,
    x: Real<M>,
}

impl<M: Machine> Sign<M> {
    /// κρ² + γ3 (ρ + x)² + 2ρx + x².
    fn below(&self) -> Real<M> {
        let Self { kappa, gamma, rho, x, .. } = *self;
        kappa * rho.square() + gamma * (rho + x).square() + 2.0 * rho * x + x.square()
    }
    /// (κ + γ3) ρ² + 2ρx.
    fn above(&self) -> Real<M> {
        (self.kappa + self.gamma) * self.rho.square() + 2.0 * self.rho * self.x
    }
}

/// The upper side of |ê|.
fn not_negative<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [s, e, computed_s, computed_e, sum] = r.each(["a r²", "|e|", "fl(a r²)", "|ê|", "fl(|ê|²)"]);
    let [kappa, gamma, rho, x] = r.each(["κ", "γ3", "ρ", "x"]);
    let sign = Sign { s, e, z: computed_s - sum, kappa, gamma, rho, x };
    follows(
        vec![
            ("D is not negative", e.square().at_most(s)),
            ("a r² is at most ρ²", r.all(&[r.not_negative([rho]), s.at_most(rho.square())])),
            (
                "|ê| is longer by at most x",
                r.all(&[r.not_negative([computed_e, e]), computed_e.at_most(e + x)]),
            ),
            ("a r² is off by at most κ", ((1.0 - kappa) * s).at_most(computed_s)),
            ("|ê|² by at most γ3", sum.at_most((1.0 + gamma) * computed_e.square())),
            ("x, κ and γ3 are not negative", r.not_negative([x, kappa, gamma])),
        ],
        vec![
            ("|e| is at most ρ", e.at_most(rho)),
            ("the square of |ê| is at most", computed_e.square().at_most((e + x).square())),
            ("and that of ρ and x is no less", (e + x).square().at_most((rho + x).square())),
            ("κ a r² is at most κ ρ²", (kappa * s).at_most(kappa * rho.square())),
            ("γ3's part", (gamma * computed_e.square()).at_most(gamma * (rho + x).square())),
            ("x's part", (e * x).at_most(rho * x)),
        ],
        vec![
            ("z is less than D by at most the lower threshold", {
                (-sign.below()).at_most(sign.z - (sign.s - sign.e.square()))
            }),
            ("z is not below it", (-sign.below()).at_most(sign.z)),
        ],
    )
}

/// The lower side of |ê|, with x' = P + R √a r.
fn negative<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [s, e, computed_s, computed_e, sum] = r.each(["√a r", "|e|", "fl(a r²)", "|ê|", "fl(|ê|²)"]);
    let [kappa, gamma, rho, p, rate] = r.each(["κ", "γ3", "ρ", "P", "R"]);
    let x = p + rate * rho;
    let sign = Sign { s, e, z: computed_s - sum, kappa, gamma, rho, x };
    let off = p + rate * s;
    let (zero, one) = (r.number(0.0), r.number(1.0));
    follows(
        vec![
            ("D is negative", s.below(e)),
            ("√a r is at most ρ, and a length", r.all(&[zero.at_most(s), s.at_most(rho)])),
            ("|ê| is shorter by at most P + R |e|", {
                r.all(&[zero.at_most(computed_e), (e - rate * e - p).at_most(computed_e)])
            }),
            ("a r² is off by at most κ", computed_s.at_most((1.0 + kappa) * s.square())),
            ("|ê|² by at most γ3", ((1.0 - gamma) * computed_e.square()).at_most(sum)),
            ("P, R, κ and γ3 are not negative, and γ3 at most 1", {
                r.all(&[r.not_negative([p, rate, kappa, gamma]), gamma.at_most(one)])
            }),
        ],
        vec![
            ("√a r's own x is at most x", off.at_most(x)),
            ("κ a r² is at most κ ρ²", (kappa * s.square()).at_most(kappa * rho.square())),
            ("if √a r is above its x, then |ê| is at least the difference", {
                r.implies(off.at_most(s), (s - off).at_most(computed_e))
            }),
            ("and its square", {
                r.implies(off.at_most(s), (s - off).square().at_most(computed_e.square()))
            }),
            ("and what is computed of it", {
                r.implies(off.at_most(s), ((1.0 - gamma) * (s - off).square()).at_most(sum))
            }),
            ("which is less than a r² by γ3 ρ² and 2 ρ x", {
                r.implies(
                    off.at_most(s),
                    (s.square() - (1.0 - gamma) * (s - off).square())
                        .at_most(gamma * rho.square() + 2.0 * rho * x),
                )
            }),
            ("else a r² itself is below 2 ρ x", {
                r.implies(s.below(off), s.square().at_most(2.0 * rho * x))
            }),
            ("and no square is negative", r.all(&[zero.at_most(sum), zero.at_most(gamma * rho.square())])),
        ],
        vec![("z is at most the upper threshold", sign.z.at_most(sign.above()))],
    )
}

/// For a true hit the upper side of the error.
fn hit_above<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [s, e, computed_s, computed_e, sum] = r.each(["a r²", "|e|", "fl(a r²)", "|ê|", "fl(|ê|²)"]);
    let [kappa, gamma, rho, x] = r.each(["κ", "γ3", "ρ", "x"]);
    let sign = Sign { s, e, z: computed_s - sum, kappa, gamma, rho, x };
    let (zero, one) = (r.number(0.0), r.number(1.0));
    follows(
        vec![
            ("D is not negative", e.square().at_most(s)),
            ("a r² is at most ρ²", r.all(&[r.not_negative([rho]), s.at_most(rho.square())])),
            (
                "|ê| is shorter by at most x",
                r.all(&[r.not_negative([computed_e, e]), (e - x).at_most(computed_e)]),
            ),
            ("a r² is off by at most κ", computed_s.at_most((1.0 + kappa) * s)),
            ("|ê|² by at most γ3", ((1.0 - gamma) * computed_e.square()).at_most(sum)),
            ("x, κ and γ3 are not negative, and γ3 at most 1", {
                r.all(&[r.not_negative([x, kappa, gamma]), gamma.at_most(one)])
            }),
        ],
        vec![
            ("|e| is at most ρ", e.at_most(rho)),
            ("κ a r² is at most κ ρ²", (kappa * s).at_most(kappa * rho.square())),
            ("if |e| is above x, the square of |ê| is at least that of the difference", {
                r.implies(x.at_most(e), (e - x).square().at_most(computed_e.square()))
            }),
            ("and what is computed of it", {
                r.implies(x.at_most(e), ((1.0 - gamma) * (e - x).square()).at_most(sum))
            }),
            ("which is less than |e|² by γ3 ρ² and 2 ρ x", {
                r.implies(
                    x.at_most(e),
                    (e.square() - (1.0 - gamma) * (e - x).square())
                        .at_most(gamma * rho.square() + 2.0 * rho * x),
                )
            }),
            ("else |e|² itself is below 2 ρ x", r.implies(e.below(x), e.square().at_most(2.0 * rho * x))),
            ("and no square is negative", r.all(&[zero.at_most(sum), zero.at_most(gamma * rho.square())])),
        ],
        vec![("z is more than D by at most the upper threshold", {
            (sign.z - (sign.s - sign.e.square())).at_most(sign.above())
        })],
    )
}

fn larger<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [kappa, gamma, rho, x] = r.each(["κ", "γ3", "ρ", "x"]);
    let zero = r.number(0.0);
    let sign = Sign { s: zero, e: zero, z: zero, kappa, gamma, rho, x };
    follows(
        vec![("γ3, ρ and x are not negative", r.not_negative([gamma, rho, x]))],
        vec![],
        vec![("the lower threshold is the larger", sign.above().at_most(sign.below()))],
    )
}

fn last<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, delta, z, d] = r.each(["u", "δ", "z", "D"]);
    let [below, above, square] = r.each(["below", "above", "ρ²"]);
    let computed = z * (1.0 + delta);
    let added = u * (square + below);
    follows(
        vec![
            ("the rounding is within u", delta.within(u)),
            ("D is of a hit", r.all(&[r.not_negative([d]), d.at_most(square)])),
            ("z is within the thresholds of D", {
                r.all(&[(-below).at_most(z - d), (z - d).at_most(above)])
            }),
            ("the lower threshold is the larger", r.all(&[above.at_most(below), r.not_negative([below])])),
        ],
        vec![
            ("z is at most ρ² and the larger", z.within(square + below)),
            ("so its rounding is u of that", (z * delta).within(added)),
        ],
        vec![
            ("D is not computed below the lower threshold and that", {
                (-(below + added)).at_most(computed)
            }),
            ("and off by at most that", {
                r.all(&[(-(below + added)).at_most(computed - d), (computed - d).at_most(above + added)])
            }),
        ],
    )
}

fn last_of_miss<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, delta, z] = r.each(["u", "δ", "z"]);
    let [below, above, square] = r.each(["below", "above", "ρ²"]);
    let one = r.number(1.0);
    follows(
        vec![
            ("the rounding is within u, below 1", r.all(&[delta.within(u), u.below(one)])),
            ("z is at most the upper threshold", z.at_most(above)),
            ("thresholds and squares are not negative", r.not_negative([above, square])),
            ("the lower threshold is the larger", above.at_most(below)),
        ],
        vec![],
        vec![("D is not computed above it and u (ρ² + the larger)", {
            (z * (1.0 + delta)).at_most(above + u * (square + below))
        })],
    )
}

/// The forms of [`optimized::bound::Rule`]: with ρ = √3 r and x = p m + q r.
fn forms<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [kappa, gamma, radius, m, p, q] = r.each(["κ", "γ3", "r", "m", "p", "q"]);
    let root = r.number(3.0).root();
    let (zero, rho, x) = (r.number(0.0), root * radius, p * m + q * radius);
    let sign = Sign { s: zero, e: zero, z: zero, kappa, gamma, rho, x };
    let sum = root + q;
    let above = [3.0 * (kappa + gamma) + 2.0 * root * q, 2.0 * root * p, zero];
    let below = [
        3.0 * kappa + gamma * sum.square() + 2.0 * root * q + q.square(),
        2.0 * (gamma * sum + root + q) * p,
        (gamma + 1.0) * p.square(),
    ];
    let form = |of: [Real<M>; 3]| of[0] * radius.square() + of[1] * radius * m + of[2] * m.square();
    follows(
        vec![],
        vec![],
        vec![
            ("the upper threshold's is that", form(above).equals(sign.above())),
            ("and the lower one's", form(below).equals(sign.below())),
        ],
    )
}

/// N = y e_Y + z e_Z of a hit.
fn foot<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (s, e, radius) = (r.each(["y", "z"]), r.each(["e Y", "e Z"]), r.get("r"));
    let (a, n) = (length(s), s[0] * e[0] + s[1] * e[1]);
    let size = e[0].square() + e[1].square();
    follows(
        vec![
            ("the ray hits", size.at_most(a * radius.square())),
            ("r is positive", r.not_negative([radius])),
        ],
        vec![
            ("a product of vectors is at most that of their lengths", n.square().at_most((a - 1.0) * size)),
            ("so its square is at most a (a − 1) r²", {
                n.square().at_most((a - 1.0) * (a * radius.square()))
            }),
            ("which is at most that of a r", n.square().at_most((a * radius).square())),
        ],
        vec![("the foot is within r of c A, times a", n.within(a * radius))],
    )
}

fn slopes<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let s = r.each(["y", "z"]);
    let a = length(s);
    let w = r.get("√(y² + z²)");
    follows(
        vec![],
        vec![],
        vec![
            ("2 (y + z)² is at most a²", (2.0 * (s[0] + s[1]).square()).at_most(a.square())),
            ("2 w is at most 1 + w²", (2.0 * w).at_most(1.0 + w.square())),
        ],
    )
}

fn across<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (s, e, radius) = (r.each(["|y|", "|z|"]), r.each(["|e Y|", "|e Z|"]), r.get("r"));
    let (a, n) = (length(s), s[0] * e[0] + s[1] * e[1]);
    let size = e[0].square() + e[1].square();
    follows(
        vec![
            ("the ray hits", size.at_most(a * radius.square())),
            ("slopes are at most 1", r.within(s, r.number(1.0))),
        ],
        vec![
            ("a is at most 3", a.at_most(r.number(3.0))),
            ("a product of vectors is at most that of their lengths", n.square().at_most((a - 1.0) * size)),
            ("so its square is at most a (a − 1) r²", {
                n.square().at_most((a - 1.0) * (a * radius.square()))
            }),
            ("3 (a − 1) is at most 2 a", (3.0 * (a - 1.0)).at_most(2.0 * a)),
            (
                "of a r² too",
                (3.0 * (a - 1.0) * (a * radius.square())).at_most(2.0 * a * (a * radius.square())),
            ),
        ],
        vec![("|y e Y| + |z e Z| is at most √(2/3) a r", {
            (3.0 * n.square()).at_most(2.0 * (a * radius).square())
        })],
    )
}

fn inverse<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, beta, b, delta, i] = r.each(["u", "β", "of a", "δ", "a of the inverse"]);
    follows(
        vec![
            ("a is off by at most β, below 1", r.all(&[b.within(beta), beta.below(r.number(1.0))])),
            ("the quotient has one rounding", delta.within(u)),
            ("it is that over a", (i * (1.0 + b)).equals(1.0 + delta)),
        ],
        vec![],
        vec![("it is off by at most η, times 1 − β", {
            ((1.0 - beta) * (i - 1.0)).within(1.0 + u - (1.0 - beta))
        })],
    )
}

/// A term of the sum: k is (K + u) m.
fn term<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [e, computed, off, k, two, three] = r.each(["e", "ê", "g", "k", "γ2", "γ3"]);
    follows(
        vec![
            ("ê is off by that", (computed - e).within(two * e.size() + k)),
            ("the product has three roundings", off.within(three)),
        ],
        vec![
            ("of ê's error", ((computed - e) * off).within((two * e.size() + k) * three)),
            ("of e", (e * off).within(e.size() * three)),
        ],
        vec![("it is off by (1 + γ3) k, and γ2 + γ3 (1 + γ2) of e", {
            (computed * (1.0 + off) - e).within((1.0 + three) * k + (two + three * (1.0 + two)) * e.size())
        })],
    )
}

fn offset<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [n, computed, off, d, tau, radius] = r.each(["N / a", "N̂ / a", "of 1/a", "d", "τ − 1", "r"]);
    follows(
        vec![
            ("the sum is off by at most d", (computed - n).within(d)),
            ("of a hit it is at most r", n.within(radius)),
            ("1/a and the product by at most τ − 1", off.within(tau)),
        ],
        vec![
            ("of the error", ((computed - n) * off).within(d * tau)),
            ("of the sum", (n * off).within(radius * tau)),
        ],
        vec![("the offset is off by at most τ d + (τ − 1) r", {
            (computed * (1.0 + off) - n).within((1.0 + tau) * d + tau * radius)
        })],
    )
}

fn sum<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, c, m, of_c] = r.each(["u", "c A", "m", "δ1"]);
    let [offset, computed, d] = r.each(["h − c A", "offset", "d"]);
    follows(
        vec![
            ("c A is at most m", c.within(m)),
            ("it is rounded once", of_c.within(u)),
            ("the offset is off by at most d", (computed - offset).within(d)),
        ],
        vec![("c A's rounding is at most u m", (c * of_c).within(u * m))],
        vec![("h is off by at most d + u m, before the sum is rounded", {
            (c * (1.0 + of_c) + computed - (c + offset)).within(d + u * m)
        })],
    )
}

fn middle<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, h, sum, d, size, last] = r.each(["u", "end", "w", "d", "m + r", "δ2"]);
    follows(
        vec![
            ("the sum is off by at most d", (sum - h).within(d)),
            ("h is at most m + r", h.within(size)),
            ("the sum is rounded once", last.within(u)),
        ],
        vec![("its rounding is at most that", (sum * last).within(u * (size + d)))],
        vec![("h is off by at most d + u (m + r + d)", {
            (sum * (1.0 + last) - h).within(d + u * (size + d))
        })],
    )
}

/// t² is what was added to D.
fn chord<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, d, radius, added, half] = r.each(["a", "D", "r", "√ of what is added", "√ of both"]);
    let one = r.number(1.0);
    follows(
        vec![
            ("a is at least 1", one.at_most(a)),
            ("D is at most a r²", d.at_most(a * radius.square())),
            ("lengths are not negative", r.not_negative([radius, added])),
            ("it is the root of both", half.square().equals(d + added.square())),
        ],
        vec![
            ("a r² is at most (a r)²", (a * radius.square()).at_most((a * radius).square())),
            ("what is added at most a² of it", added.square().at_most((a * added).square())),
            ("no product of lengths is negative", r.not_negative([a * radius, a * added, radius * added])),
            ("the sum's square is at least both", {
                ((a * radius).square() + (a * added).square()).at_most((a * (radius + added)).square())
            }),
            (
                "so its square is at most that of the sum",
                half.square().at_most((a * (radius + added)).square()),
            ),
        ],
        vec![("half a chord is at most r and the root of what was added", {
            half.at_most(a * (radius + added))
        })],
    )
}

fn added<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [d, computed, below, above] = r.each(["D", "D̂", "below", "above"]);
    let zero = r.number(0.0);
    follows(
        vec![
            ("D is not computed too low", (-below).at_most(computed - d)),
            ("nor too high", (computed - d).at_most(above)),
            ("the ray hits", zero.at_most(d)),
        ],
        vec![],
        vec![
            ("with the lower threshold it is no less than D", d.at_most(computed + below)),
            ("and at most both more", (computed + below).at_most(d + below + above)),
            ("without the upper one it is no more", (computed - above).or_more(zero).at_most(d)),
        ],
    )
}

fn half_rounding<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [u, delta, root] = r.each(["u", "δ", "√(1 + δ)"]);
    follows(
        vec![
            ("δ is within u", delta.within(u)),
            ("a root is not negative", r.all(&[r.not_negative([root]), root.square().equals(1.0 + delta)])),
        ],
        vec![],
        vec![("under a root a rounding is within u still", (root - 1.0).within(u))],
    )
}

/// With the roots of the coefficients.
fn roots<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [radius, m] = r.each(["r", "m"]);
    let [a, b, c] = r.each(["√A", "√B", "√C"]);
    let form = (a * radius).square() + b.square() * radius * m + (c * m).square();
    let sum = a * radius + b * (radius + m) / 2.0 + c * m;
    follows(
        vec![("all are not negative", r.not_negative([radius, m, a, b, c]))],
        vec![
            ("r m is at most ((r + m) / 2)²", (4.0 * radius * m).at_most((radius + m).square())),
            ("of B too", (4.0 * b.square() * radius * m).at_most((b * (radius + m)).square())),
            ("no mixed product is negative", {
                r.not_negative([
                    a * radius * (b * (radius + m)),
                    a * radius * (c * m),
                    b * (radius + m) * (c * m),
                ])
            }),
        ],
        vec![("A r² + B r m + C m² is at most (√A r + √B (r + m) / 2 + √C m)²", {
            form.at_most(sum.square())
        })],
    )
}

/// w is the computed middle with half a chord added or subtracted, z what both are at most.
struct End<M: Machine> {
    u: Real<M>,
    own: Real<M>,
    d: Real<M>,
    w: Real<M>,
    z: Real<M>,
    root: Real<M>,
    delta: [Real<M>; 2],
}

fn end<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> (End<M>, Vec<(&'static str, M::B)>) {
    let [u, own, d, w, z, root] = r.each(["u", "end", "d", "w", "z", "root"]);
    let delta = r.each(["δ1", "δ2"]);
    let assume = vec![
        ("middle and half are off by at most d", (w - own).within(d)),
        ("they are at most z", w.within(z)),
        ("roundings are within u, below 1", r.all(&[r.within(delta, u), u.below(r.number(1.0))])),
        ("the bound is no less than d and 2 u (1 + u) z, over 1 − u", {
            (d + 2.0 * u * (1.0 + u) * z).at_most((1.0 - u) * root)
        }),
    ];
    (End { u, own, d, w, z, root, delta }, assume)
}

fn lower_end<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (End { u, own, d, w, z, root, delta }, assume) = end(r);
    let x = w * (1.0 + delta[0]);
    follows(
        assume,
        vec![
            ("the sum's rounding is at most u z", (w * delta[0]).within(u * z)),
            ("the sum is off by at most d + u z", (x - own).within(d + u * z)),
            ("no root is negative", r.not_negative([root])),
            (
                "what is rounded last is at most (1 + u) z and the root",
                (x - root).within((1.0 + u) * z + root),
            ),
            ("its rounding u of that", ((x - root) * delta[1]).within(u * ((1.0 + u) * z + root))),
        ],
        vec![("the lower end is not above the true one", { ((x - root) * (1.0 + delta[1])).at_most(own) })],
    )
}

fn upper_end<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let (End { u, own, d, w, z, root, delta }, assume) = end(r);
    let x = w * (1.0 + delta[0]);
    follows(
        assume,
        vec![
            ("the sum's rounding is at most u z", (w * delta[0]).within(u * z)),
            ("the sum is off by at most d + u z", (x - own).within(d + u * z)),
            ("no root is negative", r.not_negative([root])),
            (
                "what is rounded last is at most (1 + u) z and the root",
                (x + root).within((1.0 + u) * z + root),
            ),
            ("its rounding u of that", ((x + root) * delta[1]).within(u * ((1.0 + u) * z + root))),
        ],
        vec![("the upper end is not below the true one", { own.at_most((x + root) * (1.0 + delta[1])) })],
    )
}

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let of_rounding: &[(&str, u32)] = &[
        ("u", SIXTEENTH),
        ("y", HALF),
        ("ζ", ZERO),
        ("δ1", ZERO),
        ("δ2", ZERO),
        ("δ3", ZERO),
        ("δ4", ZERO),
        ("c A", TWO),
        ("c Y", ONE),
        ("before", SIXTEENTH),
        ("both", ZERO),
    ];
    let of_map: &[(&str, u32)] = &[
        ("α Y", SIXTEENTH),
        ("α Z", SIXTEENTH),
        ("y", HALF),
        ("z", HALF),
        ("η", SIXTEENTH),
        ("K m", HALF),
        ("u m", HALF),
        ("e Y", ONE),
        ("e Z", ONE),
        ("γ2", HALF),
    ];
    let of_sign: &[(&str, u32)] = &[
        ("a r²", ONE),
        ("|e|", HALF),
        ("fl(a r²)", ONE),
        ("|ê|", HALF),
        ("fl(|ê|²)", QUARTER),
        ("κ", SIXTEENTH),
        ("γ3", SIXTEENTH),
        ("ρ", TWO),
        ("x", SIXTEENTH),
    ];
    let of_miss: &[(&str, u32)] = &[
        ("√a r", HALF),
        ("|e|", ONE),
        ("fl(a r²)", QUARTER),
        ("|ê|", ONE),
        ("fl(|ê|²)", ONE),
        ("κ", SIXTEENTH),
        ("γ3", SIXTEENTH),
        ("ρ", TWO),
        ("P", SIXTEENTH),
        ("R", SIXTEENTH),
    ];
    let of_last: &[(&str, u32)] = &[
        ("u", SIXTEENTH),
        ("δ", ZERO),
        ("z", QUARTER),
        ("D", QUARTER),
        ("below", ONE),
        ("above", HALF),
        ("ρ²", TWO),
    ];
    let of_hit: &[(&str, u32)] = &[
        ("y", HALF),
        ("z", HALF),
        ("|y|", HALF),
        ("|z|", HALF),
        ("√(y² + z²)", HALF),
        ("e Y", HALF),
        ("e Z", HALF),
        ("|e Y|", HALF),
        ("|e Z|", HALF),
        ("r", ONE),
    ];
    let of_root: &[(&str, u32)] = &[
        ("u", SIXTEENTH),
        ("β", HALF),
        ("of a", ZERO),
        ("δ", ZERO),
        ("δ1", ZERO),
        ("δ2", ZERO),
        ("a of the inverse", ONE),
        ("e", ONE),
        ("ê", ONE),
        ("g", ZERO),
        ("k", SIXTEENTH),
        ("γ2", SIXTEENTH),
        ("γ3", SIXTEENTH),
        ("N / a", HALF),
        ("N̂ / a", HALF),
        ("of 1/a", ZERO),
        ("d", SIXTEENTH),
        ("τ − 1", SIXTEENTH),
        ("r", ONE),
        ("m", TWO),
        ("c A", ONE),
        ("h − c A", HALF),
        ("m + r", TWO),
        ("offset", HALF),
        ("end", ONE),
        ("w", ONE),
        ("z", ONE),
        ("root", HALF),
    ];
    vec![
        lemma(
            "bound.cross",
            "e is the cross product of the centre and the ray, so D is that of the distance of the line",
            &[("c A", TWO), ("c Y", ONE), ("c Z", HALF), ("y", HALF), ("z", HALF)],
            step!(cross),
        ),
        lemma(
            "bound.error",
            "The error of e Y is η y, with c A's rounding, and parts of e Y and of c A",
            of_rounding,
            step!(split),
        ),
        lemma("bound.error.own", "The part of e Y is at most γ2", of_rounding, step!(own)),
        lemma("bound.error.rest", "The part of c A is at most K", of_rounding, step!(rest)),
        lemma(
            "bound.error.parts",
            "Before the last rounding, the part of c A is at most the sum of three",
            of_rounding,
            step!(parts),
        ),
        lemma(
            "bound.error.both",
            "So α is at most γ2 |e Y| + K m",
            &[
                ("e Y", ONE),
                ("c A", ONE),
                ("own", ZERO),
                ("rest", ZERO),
                ("γ2", SIXTEENTH),
                ("K", SIXTEENTH),
                ("m", TWO),
            ],
            step!(component),
        ),
        lemma("bound.map", "The map takes α + η s to √(a |α|² + a η² − (α·s − η)²)", of_map, step!(mapped)),
        lemma(
            "bound.map.constant",
            "Of K m and u m that is at most √(6 K² + 3 u²) m",
            of_map,
            step!(constant),
        ),
        lemma("bound.map.scaled", "Of γ2 e it is at most √3 γ2 |e|", of_map, step!(scaled)),
        lemma(
            "bound.products",
            "The products of e X are at most √2 (1 + γ2) |e| + 2 (K + u) m",
            &[
                ("|e Y|", ZERO),
                ("|e Z|", ONE),
                ("|y|", HALF),
                ("|z|", HALF),
                ("γ2", SIXTEENTH),
                ("k", SIXTEENTH),
                ("√(e Y² + e Z²)", ONE),
            ],
            step!(products),
        ),
        lemma(
            "bound.triangle",
            "A sum of vectors is no longer than both",
            &[("|x|", ONE), ("|y|", ONE), ("x·y", ONE), ("|x + y|", TWO)],
            step!(triangle),
        ),
        lemma(
            "bound.a",
            "a is off by at most β, which is below 1, as γ3 is",
            &[("u", SMALL), ("y² + z²", ONE)],
            step!(a),
        ),
        lemma("bound.kappa", "a r² is off by at most κ", of_root, step!(kappa)),
        lemma(
            "bound.sign.hit",
            "If D >= 0, z is not below the lower threshold",
            of_sign,
            step!(not_negative),
        ),
        lemma("bound.sign.miss", "If D < 0, z is not above the upper threshold", of_miss, step!(negative)),
        lemma(
            "bound.sign.error",
            "If D >= 0, z is above D by at most the upper threshold",
            of_sign,
            step!(hit_above),
        ),
        lemma("bound.sign.larger", "The lower threshold is the larger", of_sign, step!(larger)),
        lemma(
            "bound.sign.last",
            "The last rounding adds u (ρ² + the larger), for a hit",
            of_last,
            step!(last),
        ),
        lemma("bound.sign.last.miss", "And for a miss", of_last, step!(last_of_miss)),
        lemma(
            "bound.sign.forms",
            "With ρ = √3 r and x = p m + q r the thresholds are forms in r and m",
            &[("κ", ONE), ("γ3", ONE), ("r", ZERO), ("m", ONE), ("p", HALF), ("q", HALF)],
            step!(forms),
        ),
        lemma("bound.root.foot", "Of a true hit, |h − c A| <= r", of_hit, step!(foot)),
        lemma("bound.root.slopes", "(|y| + |z|) / a is at most √(1/2)", of_hit, step!(slopes)),
        lemma(
            "bound.root.across",
            "Of a true hit, |y e Y| + |z e Z| is at most √(2/3) a r",
            of_hit,
            step!(across),
        ),
        lemma("bound.root.inverse", "1/a is off by at most η", of_root, step!(inverse)),
        lemma(
            "bound.root.term",
            "A term of the foot's offset is off by that of ê and three roundings",
            of_root,
            step!(term),
        ),
        lemma("bound.root.offset", "The offset is off by at most τ d + (τ − 1) r", of_root, step!(offset)),
        lemma("bound.root.sum", "The middle is off by that and by u m", of_root, step!(sum)),
        lemma("bound.root.middle", "And by u of the sum", of_root, step!(middle)),
        lemma(
            "bound.root.added",
            "With its thresholds D is on the safe side, by at most both",
            &[("D", QUARTER), ("D̂", HALF), ("below", ONE), ("above", HALF)],
            step!(added),
        ),
        lemma(
            "bound.root.chord",
            "Half a chord of D and what is added is at most r and the root of that",
            &[("a", ONE), ("D", ONE), ("r", ONE), ("√ of what is added", ZERO), ("√ of both", ONE)],
            step!(chord),
        ),
        lemma(
            "bound.root.half",
            "Under a root a rounding counts no more",
            &[("u", HALF), ("δ", ZERO), ("√(1 + δ)", ONE)],
            step!(half_rounding),
        ),
        lemma(
            "bound.root.forms",
            "√(A r² + B r m + C m²) is at most √A r + √B (r + m) / 2 + √C m",
            &[("r", ONE), ("m", TWO), ("√A", ONE), ("√B", HALF), ("√C", ONE)],
            step!(roots),
        ),
        lemma("bound.root.lower", "The lower end is not above the true one", of_root, step!(lower_end)),
        lemma("bound.root.upper", "The upper end is not below the true one", of_root, step!(upper_end)),
    ]
}
