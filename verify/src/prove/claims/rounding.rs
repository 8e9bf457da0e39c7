//! Claim: the bound of the f64 stage follows from the steps that stand in [`optimized::double`], 1 to 14 for any ray (`rounding.root`) and 1
//! to 7 for the short way (`rounding.short`), for every unit roundoff v up to 2⁻⁸ and 2⁻¹².
//!
//! Each lemma is one inequality of that step, over the reals and with the names of that text; from one to the next it is substitution.
//! The text's M is the least that is allowed, 1 + 40 v: a greater one only makes `slack` and `error` greater. Where it has |ŵ|, F n or √G, a
//! lemma has a number that is not negative and what is known of its square.
//!
//! *What is no inequality of real numbers* is how many roundings a term of the kernel meets, that products of inputs are exact, and that
//! nothing leaves the range of f64. These are read off the source; all inputs of floats of 8 and 16 bits go through the
//! same source in `tests/rounding.rs`. How k roundings add up is proved by induction: `rounding.more` and `rounding.back`.

use super::real::{
    HALF, MINUS_ONE, MINUS_TWO, ONE, QUARTER, Real, Reals, SEVEN_SIXTEENTHS, SIXTEENTH, SMALL, SMALLER,
    THREE, TINY, TWO, ZERO, follows, lemma, step,
};
use crate::prove::theorem::{Ask, Lemma, Statement};
use optimized::machine::Machine;

/// 1 + 40 v.
fn more<M: Machine>(v: Real<M>) -> Real<M> {
    1.0 + 40.0 * v
}

/// (1 + v)ᵏ − 1.
fn gamma<M: Machine>(v: Real<M>, k: u32) -> Real<M> {
    (1.0 + v).power(k) - 1.0
}

/// If k roundings are within g, one more is within (1 + g)(1 + v) − 1.
fn one_more<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, limit, off, delta] = r.each(["v", "g", "off", "δ"]);
    follows(
        vec![("k roundings are within g", off.within(limit)), ("one is within v", delta.within(v))],
        vec![],
        vec![("all are", ((1.0 + off) * (1.0 + delta) - 1.0).within((1.0 + limit) * (1.0 + v) - 1.0))],
    )
}

/// The same of the computed: with c = (1 − v)⁻ᵏ, times (1 − v).
fn one_back<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, ratio, delta] = r.each(["v", "c", "true by computed", "δ"]);
    let one = r.number(1.0);
    follows(
        vec![
            ("after k roundings the true is within c − 1 of the computed", {
                (ratio * (1.0 + delta) - 1.0).within(c - 1.0)
            }),
            ("one is within v, below 1", r.all(&[delta.within(v), v.below(one)])),
        ],
        vec![],
        vec![("after one more it is within c / (1 − v) − 1", {
            ((1.0 - v) * (ratio - 1.0)).within(c - (1.0 - v))
        })],
    )
}

/// Step 1.
fn component<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [x, y, g, h, limit] = r.each(["fy dz", "fz dy", "g", "h", "γ3"]);
    let computed = x * (1.0 + g) - y * (1.0 + h);
    follows(
        vec![("each term is off by at most γ3", r.within([g, h], limit))],
        vec![],
        vec![("so is the difference, of both terms", {
            (computed - (x - y)).within(limit * (x.size() + y.size()))
        })],
    )
}

/// f, d and the magnitudes of their products.
fn vectors<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> [[Real<M>; 3]; 3] {
    let (f, d) = (r.each(["f x", "f y", "f z"]), r.each(["d x", "d y", "d z"]));
    [f, d, [f[0] * d[0], f[1] * d[1], f[2] * d[2]]]
}

fn sum<M: Machine>([x, y, z]: [Real<M>; 3]) -> Real<M> {
    x + y + z
}

fn square<M: Machine>([x, y, z]: [Real<M>; 3]) -> Real<M> {
    x * x + y * y + z * z
}

fn mixed<M: Machine>([x, y, z]: [Real<M>; 3]) -> Real<M> {
    x * y + y * z + z * x
}

/// Step 2: the squared length of the vector of sums.
fn lengths<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [f, d, x] = vectors(r);
    let sums =
        [f[1] * d[2] + f[2] * d[1], f[2] * d[0] + f[0] * d[2], f[0] * d[1] + f[1] * d[0]].map(Real::square);
    follows(
        vec![],
        vec![],
        vec![("it is F² n² − (Σ x)² + 4 Σ x x", {
            sum(sums).equals(square(f) * square(d) - sum(x).square() + 4.0 * mixed(x))
        })],
    )
}

fn products<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let x = r.each(["x", "y", "z"]);
    follows(vec![], vec![], vec![("3 Σ x x is at most (Σ x)²", (3.0 * mixed(x)).at_most(sum(x).square()))])
}

/// Cauchy and Schwarz, in three dimensions.
fn cauchy<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [f, d, x] = vectors(r);
    let cross = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
    let rest = square(f) * square(d) - sum(x).square();
    follows(
        vec![],
        vec![("what is left is the cross product's square (Lagrange)", rest.equals(square(cross)))],
        vec![("(f·d)² is at most F² n²", r.number(0.0).at_most(rest))],
    )
}

fn cross<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    let p = r.ratio(348.0, 100.0) * v;
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![("4/3 γ3² is at most (3.48 v)²", { (4.0 * gamma(v, 3).square()).at_most(3.0 * p.square()) })],
    )
}

/// Step 3: with k the product of ŵ and ŵ − w, of which 2 covers k² <= |ŵ|² |ŵ − w|².
fn squares<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [long, off, p, k] = r.each(["|ŵ|", "|ŵ − w|", "p", "ŵ·(ŵ − w)"]);
    let true_square = long.square() - 2.0 * k + off.square();
    follows(
        vec![
            ("|ŵ| is a length", r.not_negative([long])),
            ("|ŵ − w| is one, and at most p", r.all(&[r.not_negative([off]), off.at_most(p)])),
            ("a product of vectors is at most that of their lengths", k.within(long * off)),
        ],
        vec![],
        vec![("the squares differ by at most 2 p |ŵ| + p²", {
            (long.square() - true_square).within(2.0 * p * long + p.square())
        })],
    )
}

/// Step 4: g is (1 − v)⁻³ − 1, s what step 3 allows.
fn discriminant<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, g, s, delta] = r.each(["v", "g", "s", "δ"]);
    let [computed, own] = r.each(["A", "a r²"]);
    let [w_computed, w_own, w] = r.each(["W", "|ŵ|²", "|w|²"]);
    let both = computed + w_computed;
    follows(
        vec![
            ("A and W are squares", r.not_negative([computed, w_computed])),
            ("A has three roundings", (own - computed).within(g * computed)),
            ("W has three roundings", (w_own - w_computed).within(g * w_computed)),
            ("the difference has one", delta.within(v)),
            ("|ŵ|² is right but for that of step 3", (w_own - w).within(s)),
        ],
        vec![("its rounding is at most v (A + W)", { ((computed - w_computed) * delta).within(v * both) })],
        vec![("D is off by at most (g + v) (A + W) and that", {
            ((computed - w_computed) * (1.0 + delta) - (own - w)).within((g + v) * both + s)
        })],
    )
}

/// Step 5: squares in order have roots in order; c is (1 − v)⁴, or (1 − v)^(3/2).
fn lengths_in_order<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [long, computed, c] = r.each(["length", "root of the computed", "c"]);
    follows(
        vec![
            ("lengths are not negative, nor is c", r.not_negative([long, computed, c])),
            ("c² of the true square is at most the computed", {
                (long.square() * c.square()).at_most(computed.square())
            }),
        ],
        vec![],
        vec![("c of the length is at most its root", (long * c).at_most(computed))],
    )
}

/// Step 6: the first terms, with h = (1 − v)⁷, which is more than step 5 needs.
fn first_term<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, h, long, short, computed, more] = r.each(["v", "h", "F n", "|ŵ|", "√(G W)", "M"]);
    let (zero, seven) = (r.number(0.0), r.ratio(696.0, 100.0));
    follows(
        vec![
            ("v and h are positive", r.all(&[zero.below(v), zero.below(h)])),
            ("step 5 holds of both", (long * short * h).at_most(computed)),
            ("M is no less than a. says, and the root no length below 0", {
                r.all(&[seven.at_most(7.0 * more * h.square()), r.not_negative([computed])])
            }),
        ],
        vec![],
        vec![("7 M v √(G W), rounded, is at least 2 p |ŵ|", {
            (seven * v * long * short).at_most(7.0 * more * v * computed * h)
        })],
    )
}

fn slack_a<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![("6.96 is at most 7 M (1 − v)¹⁴", {
            r.ratio(696.0, 100.0).at_most(7.0 * more(v) * (1.0 - v).power(14))
        })],
    )
}

fn slack_b<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    let d = 1.0 - v;
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![("1 − (1 − v)³ + v (1 − v)³ is at most 5 M v (1 − v)⁸", {
            (1.0 - d.power(3) + v * d.power(3)).at_most(5.0 * more(v) * v * d.power(8))
        })],
    )
}

fn slack_c<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    let (p, square) = (r.ratio(348.0, 100.0), r.ratio(1212.0, 100.0));
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![
            ("p² is at most 12.12 of v² F² n²", p.square().at_most(square)),
            ("12.12 is at most 14 (1 − v)¹⁰", square.at_most(14.0 * (1.0 - v).power(10))),
        ],
    )
}

/// Step 7: g is (1 − v)⁻⁵ − 1.
fn eye_square<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, g, delta, computed, own, rr] = r.each(["v", "g", "δ", "F̂²", "F²", "r²"]);
    follows(
        vec![
            ("F̂² and r² are squares", r.not_negative([computed, rr])),
            ("F² has five roundings", (own - computed).within(g * computed)),
            ("the difference has one", delta.within(v)),
        ],
        vec![("its rounding is at most v (F̂² + r²)", {
            ((computed - rr) * delta).within(v * (computed + rr))
        })],
        vec![("q is off by at most g F̂² + v (F̂² + r²)", {
            ((computed - rr) * (1.0 + delta) - (own - rr)).within(g * computed + v * (computed + rr))
        })],
    )
}

fn eye_slack<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    let d = 1.0 - v;
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![
            ("1 − (1 − v)⁵ + v (1 − v)⁵ is at most 6 M v (1 − v)⁸", {
                (1.0 - d.power(5) + v * d.power(5)).at_most(6.0 * more(v) * v * d.power(8))
            }),
            ("1 is at most M (1 − v)²", r.number(1.0).at_most(more(v) * d.square())),
        ],
    )
}

/// Step 8: three terms.
fn along<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [x, y, z, limit] = r.each(["x", "y", "z", "γ4"]);
    let off = r.each(["g", "h", "k"]);
    let computed = x * (1.0 + off[0]) + y * (1.0 + off[1]) + z * (1.0 + off[2]);
    follows(
        vec![("each term is off by at most γ4", r.within(off, limit))],
        vec![
            ("the first by γ4 |x|", (x * off[0]).within(limit * x.size())),
            ("the second by γ4 |y|", (y * off[1]).within(limit * y.size())),
            ("the third by γ4 |z|", (z * off[2]).within(limit * z.size())),
        ],
        vec![("the sum by γ4 Σ |f d|", {
            (computed - (x + y + z)).within(limit * (x.size() + y.size() + z.size()))
        })],
    )
}

fn along_slack<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![("γ4 is at most 4 M v (1 − v)⁶", {
            gamma(v, 4).at_most(4.0 * more(v) * v * (1.0 - v).power(6))
        })],
    )
}

/// Step 9: a sign beyond its slack.
fn sign<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [computed, own, slack] = r.each(["computed", "true", "slack"]);
    let zero = r.number(0.0);
    follows(
        vec![("it is off by at most its slack", (computed - own).within(slack))],
        vec![],
        vec![
            ("what is above it is positive", r.implies(slack.below(computed), zero.below(own))),
            ("what is below minus it is negative", r.implies(computed.below(-slack), own.below(zero))),
        ],
    )
}

/// a t² + 2 b t + q.
fn distance<M: Machine>([a, b, q]: [Real<M>; 3], t: Real<M>) -> Real<M> {
    a * t.square() + 2.0 * b * t + q
}

fn no_line<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, b, q, t] = r.each(["a", "b", "q", "t"]);
    let zero = r.number(0.0);
    follows(
        vec![("D is negative", (b.square() - a * q).below(zero)), ("a is a length's square", zero.below(a))],
        vec![("a times it is (a t + b)² − D", {
            (a * distance([a, b, q], t)).equals((a * t + b).square() - (b.square() - a * q))
        })],
        vec![("no point of the line lies on the sphere", zero.below(distance([a, b, q], t)))],
    )
}

fn behind<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, b, q, t] = r.each(["a", "b", "q", "t"]);
    let zero = r.number(0.0);
    follows(
        vec![
            ("the eye is outside", zero.below(q)),
            ("b is positive", zero.below(b)),
            ("the point lies ahead, and a is a square", r.not_negative([t, a])),
        ],
        vec![],
        vec![("it lies outside the sphere", zero.below(distance([a, b, q], t)))],
    )
}

/// The nearer root, and that no point before it is on the sphere.
fn outside<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, b, q, s, t, before] = r.each(["a", "b", "q", "S", "t", "s"]);
    let zero = r.number(0.0);
    let far = s - b;
    follows(
        vec![
            ("the eye is outside, and b negative", r.all(&[zero.below(q), b.below(zero)])),
            ("a is positive", zero.below(a)),
            ("S is √D", r.all(&[r.not_negative([s]), s.square().equals(b.square() - a * q)])),
            ("t is q / (S − b)", (t * far).equals(q)),
            ("another point lies before it, not behind", r.all(&[zero.at_most(before), before.below(t)])),
        ],
        vec![
            ("S is less than −b", s.below(-b)),
            ("a t is −b − S", (a * t * far).equals((-b - s) * far)),
            ("and so", (a * t).equals(-b - s)),
            ("the other is before the root, in a", (a * before).below(-b - s)),
            ("times a, it is the product of its distances from both roots", {
                (a * distance([a, b, q], before)).equals((-b - s - a * before) * (far - a * before))
            }),
            ("which is positive", zero.below((-b - s - a * before) * (far - a * before))),
        ],
        vec![
            ("t is positive", zero.below(t)),
            ("the other is not on the sphere", zero.below(a * distance([a, b, q], before))),
        ],
    )
}

/// The farther root seen from inside, in either form.
fn inside<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [a, b, q, s, t, before] = r.each(["a", "b", "q", "S", "t", "s"]);
    let zero = r.number(0.0);
    follows(
        vec![
            ("the eye is inside", q.below(zero)),
            ("a is positive", zero.below(a)),
            ("S is √D", r.all(&[r.not_negative([s]), s.square().equals(b.square() - a * q)])),
            ("t is (S − b) / a", (t * a).equals(s - b)),
            ("another point lies before it, not behind", r.all(&[zero.at_most(before), before.below(t)])),
        ],
        vec![
            ("−a q is positive", zero.below(-(a * q))),
            ("S is more than |b|", b.size().below(s)),
            ("the other is before the root, in a", (a * before).below(s - b)),
            ("times a, it is the product of its distances from both roots", {
                (a * distance([a, b, q], before)).equals(-((s - b - a * before) * (s + b + a * before)))
            }),
            ("which is negative", zero.below((s - b - a * before) * (s + b + a * before))),
            ("the forms are one, in a", (a * t * (s + b)).equals(-(a * q))),
        ],
        vec![
            ("t is positive", zero.below(t)),
            ("it is −q / (S + b)", (t * (s + b)).equals(-q)),
            ("the other is not on the sphere", (a * distance([a, b, q], before)).below(zero)),
        ],
    )
}

/// Step 10: the range of z.
fn half_way<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [x, z] = r.each(["x", "z"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    follows(
        vec![
            ("x is 2 z − z²", x.equals(2.0 * z - z.square())),
            ("x is below 1/2", x.below(r.ratio(1.0, 2.0))),
            ("z is from 0 to 1", r.all(&[zero.at_most(z), z.at_most(one)])),
        ],
        vec![],
        vec![("z is below 0.3", z.below(r.ratio(3.0, 10.0)))],
    )
}

/// Step 10: roots of what differs by x.
fn roots<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [own, computed, z] = r.each(["√D", "√D̂", "z"]);
    let zero = r.number(0.0);
    let x = 2.0 * z - z.square();
    follows(
        vec![
            ("√D is not negative", zero.at_most(own)),
            ("nor is √D̂, and D̂ is off by at most x of itself", {
                r.all(&[
                    zero.at_most(computed),
                    (own.square() - computed.square()).within(x * computed.square()),
                ])
            }),
        ],
        vec![],
        vec![("√D̂ is off by at most z of itself", (own - computed).within(z * computed))],
    )
}

/// Step 11, times 1 − v; b counts as −b where the other sum is taken.
fn sums<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, z, beta, b, computed_b] = r.each(["v", "z", "β", "b", "b̂"]);
    let [s, root, computed_s] = r.each(["S", "√D̂", "ŝ"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    let (own, computed) = (s - b, computed_b.size() + computed_s);
    follows(
        vec![
            ("b̂ is not positive", computed_b.at_most(zero)),
            ("b is off by at most β", (b - computed_b).within(beta)),
            ("S is within z of √D̂", (s - root).within(z * root)),
            ("which is rounded once", r.all(&[(computed_s - root).within(v * root), zero.at_most(root)])),
            ("v and z are in range", r.all(&[v.below(one), zero.at_most(v), zero.at_most(z)])),
        ],
        vec![
            ("√D̂ is at most ŝ / (1 − v)", (root * (1.0 - v)).at_most(computed_s)),
            ("S is off by at most (z + v) √D̂", (s - computed_s).within((z + v) * root)),
            ("that is (z + v) ŝ / (1 − v)", {
                ((z + v) * root * (1.0 - v)).at_most((z + v) * computed_s)
            }),
            ("the sum is off by β and that", (own - computed).within(beta + (z + v) * root)),
        ],
        vec![("the sum is off by at most β + (z + v) ŝ / (1 − v)", {
            ((own - computed) * (1.0 - v)).within(beta * (1.0 - v) + (z + v) * computed_s)
        })],
    )
}

/// Step 12.
fn eleven<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    follows(
        vec![("v is in range", r.in_unit(v, 256.0))],
        vec![],
        vec![("1 + 27 v is at most M (1 − v)¹¹", {
            (1.0 + 27.0 * v).at_most(more(v) * (1.0 - v).power(11))
        })],
    )
}

/// The variables of steps 13 and 14.
struct Terms<M: Machine> {
    v: Real<M>,
    /// c (1 − v).
    c: Real<M>,
    /// e₀ without ε.
    rest: Real<M>,
    /// They are in range.
    ranges: M::B,
}

fn terms<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Terms<M> {
    let [v, z, y, b] = r.each(["v", "z", "y", "β/σ"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    let x = 2.0 * z - z.square();
    let ranges = r.all(&[
        r.in_unit(v, 256.0),
        zero.at_most(z),
        z.at_most(r.ratio(3.0, 10.0)),
        zero.at_most(y),
        y.at_most(one),
        zero.at_most(b),
    ]);
    Terms { v, c: b * (1.0 - v) + (z + v) * y, rest: 2.0 * b + (x + v) * y + 4.0 * v, ranges }
}

/// Step 13, upper end: c in terms of the error.
fn share<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Terms { v, c, rest, ranges } = terms(r);
    follows(
        vec![("v, z, y and β/σ are in range", ranges)],
        vec![],
        vec![
            ("17 c (1 − v) is at most 10 e₀ − 33 v", (17.0 * c).at_most(10.0 * rest - 33.0 * v)),
            ("c (1 − v) is at most e₀ − 4 v", c.at_most(rest - 4.0 * v)),
        ],
    )
}

/// Step 13, upper end, from there.
fn quotient_above<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, rest, own] = r.each(["v", "c (1 − v)", "e₀ − ε", "ε"]);
    let d = 1.0 - v;
    let e = (1.0 + 27.0 * v) * (own + rest);
    follows(
        vec![
            ("v is in range", r.in_unit(v, 256.0)),
            ("ε is not negative", r.not_negative([own])),
            ("c is at most its share", (17.0 * c).at_most(10.0 * rest - 33.0 * v)),
            ("and at most e₀ − 4 v", c.at_most(rest - 4.0 * v)),
            ("and not negative", r.not_negative([c])),
            ("e is below 1/2", e.below(r.ratio(1.0, 2.0))),
        ],
        vec![],
        vec![("(1 + ε)(1 + v) is at most (1 − c)(1 + e)(1 − v)³", {
            ((1.0 + own) * (1.0 + v) * d).at_most((d - c) * (1.0 + e) * d.power(3))
        })],
    )
}

fn quotient_below<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Terms { v, c, rest, ranges } = terms(r);
    let own = r.get("ε");
    let (d, e) = (1.0 - v, (1.0 + 27.0 * v) * (own + rest));
    follows(
        vec![("v, z, y and β/σ are in range", ranges), ("ε is not negative", r.not_negative([own]))],
        vec![],
        vec![("(1 − e)(1 + c)(1 + v)³ is at most (1 − ε)(1 − v)", {
            ((1.0 - e) * (d + c) * (1.0 + v).power(3)).at_most((1.0 - own) * d.square())
        })],
    )
}

/// The upper end of a quotient, if step 13 holds: in units of the computed q.
fn quotient_hi<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, own, e] = r.each(["v", "c", "ε", "e"]);
    let [q, sum, t] = r.each(["q", "Σ", "t"]);
    let [computed_sum, computed_t, hi] = r.each(["σ", "t̂", "hi"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    let (d, s) = (1.0 - v, 1.0 + v);
    follows(
        vec![
            ("v, e and c are in range", r.all(&[r.not_negative([v, e]), v.below(one), c.below(one)])),
            ("q is at most 1 + ε", q.at_most(1.0 + own)),
            ("Σ is at least 1 − c of σ, which is positive", {
                r.all(&[((1.0 - c) * computed_sum).at_most(sum), zero.below(computed_sum)])
            }),
            ("t is q / Σ", r.all(&[(t * sum).equals(q), r.not_negative([t])])),
            ("t̂ has two roundings", d.at_most(computed_t * computed_sum * s)),
            ("the end has two more", (computed_t * (1.0 + e) * d.square()).at_most(hi)),
            ("step 13 holds", ((1.0 + own) * s).at_most((1.0 - c) * (1.0 + e) * d.power(3))),
        ],
        vec![
            ("t σ (1 − c) is at most 1 + ε", (t * computed_sum * (1.0 - c)).at_most(1.0 + own)),
            ("which is at most the end's", {
                ((1.0 + own) * s)
                    .at_most((1.0 - c) * (computed_t * computed_sum * s * (1.0 + e) * d.square()))
            }),
        ],
        vec![("t is at most hi", t.at_most(hi))],
    )
}

/// The lower end.
fn quotient_lo<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, own, e] = r.each(["v", "c", "ε", "e"]);
    let [q, sum, t] = r.each(["q", "Σ", "t"]);
    let [computed_sum, computed_t, lo] = r.each(["σ", "t̂", "lo"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    let (d, s) = (1.0 - v, 1.0 + v);
    follows(
        vec![
            ("v, e and c are in range", { r.all(&[r.not_negative([v, c]), v.below(one), e.at_most(one)]) }),
            ("q is at least 1 − ε", (1.0 - own).at_most(q)),
            ("Σ is at most 1 + c of σ, and positive, as that is", {
                r.all(&[sum.at_most((1.0 + c) * computed_sum), zero.below(sum), zero.below(computed_sum)])
            }),
            ("t is q / Σ", r.all(&[(t * sum).equals(q), r.not_negative([t])])),
            ("t̂ has two roundings", (computed_t * computed_sum * d).at_most(s)),
            ("the end has two more", lo.at_most(computed_t * (1.0 - e) * s.square())),
            ("step 13 holds", ((1.0 - e) * (1.0 + c) * s.power(3)).at_most((1.0 - own) * d)),
        ],
        vec![
            ("t σ (1 + c) is at least 1 − ε", (1.0 - own).at_most(t * computed_sum * (1.0 + c))),
            ("which is at least the end's", {
                (d * computed_t * computed_sum * (1.0 - e) * (1.0 + c) * s.square()).at_most((1.0 - own) * d)
            }),
        ],
        vec![("lo is at most t", lo.at_most(t))],
    )
}

/// Step 14.
fn sum_above<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Terms { v, c, rest, ranges } = terms(r);
    let d = 1.0 - v;
    let e = (1.0 + 27.0 * v) * (3.0 * v + rest);
    follows(
        vec![("v, z, y and β/σ are in range", ranges)],
        vec![],
        vec![("(1 + c)(1 + v)² is at most (1 + e)(1 − v)⁴", {
            ((d + c) * (1.0 + v).square()).at_most((1.0 + e) * d.power(5))
        })],
    )
}

fn sum_below<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Terms { v, c, rest, ranges } = terms(r);
    let d = 1.0 - v;
    let e = (1.0 + 27.0 * v) * (3.0 * v + rest);
    follows(
        vec![("v, z, y and β/σ are in range", ranges)],
        vec![],
        vec![("(1 − e)(1 + v)⁴ is at most (1 − c)(1 − v)²", {
            ((1.0 - e) * (1.0 + v).power(4) * d).at_most((d - c) * d.square())
        })],
    )
}

/// The ends of a sum over a, if step 14 holds: in units of σ / a.
fn sum_hi<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, e, t, computed, hi] = r.each(["v", "c", "e", "t", "t̂", "hi"]);
    let (d, s) = (1.0 - v, 1.0 + v);
    follows(
        vec![
            ("v and e are in range", r.all(&[r.not_negative([v, e]), v.below(r.number(1.0))])),
            ("Σ is at most 1 + c", t.at_most(1.0 + c)),
            ("t̂ has four roundings", d.square().at_most(computed * s.square())),
            ("the end has two more", (computed * (1.0 + e) * d.square()).at_most(hi)),
            ("step 14 holds", ((1.0 + c) * s.square()).at_most((1.0 + e) * d.power(4))),
        ],
        vec![],
        vec![("t is at most hi", t.at_most(hi))],
    )
}

fn sum_lo<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, e, t, computed, lo] = r.each(["v", "c", "e", "t", "t̂", "lo"]);
    let (d, s, one) = (1.0 - v, 1.0 + v, r.number(1.0));
    follows(
        vec![
            ("v and e are in range", r.all(&[r.not_negative([v]), v.below(one), e.at_most(one)])),
            ("Σ is at least 1 − c", (1.0 - c).at_most(t)),
            ("t̂ has four roundings", (computed * d.square()).at_most(s.square())),
            ("the end has two more", lo.at_most(computed * (1.0 - e) * s.square())),
            ("step 14 holds", ((1.0 - e) * s.power(4)).at_most((1.0 - c) * d.square())),
        ],
        vec![],
        vec![("lo is at most t", lo.at_most(t))],
    )
}

/// Short way, step 1: q and b.
fn short_parts<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    follows(
        vec![("v is in range", r.in_unit(v, 4096.0))],
        vec![],
        vec![
            ("γ5 + v (1 + v)⁵ is at most 6.01 v", {
                (gamma(v, 5) + v * (1.0 + v).power(5)).at_most(r.ratio(601.0, 100.0) * v)
            }),
            ("γ4 is at most 4.01 v", gamma(v, 4).at_most(r.ratio(401.0, 100.0) * v)),
        ],
    )
}

/// Step 1: q, in units of F².
fn short_eye<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, limit, off, delta, rr] = r.each(["v", "γ5", "g", "δ", "r²"]);
    let (computed, one) = (1.0 + off, r.number(1.0));
    follows(
        vec![
            ("F² has five roundings", off.within(limit)),
            ("the difference has one", delta.within(v)),
            ("r² is at most either of them, and not negative", {
                r.all(&[r.not_negative([rr]), rr.at_most(one), rr.at_most(computed)])
            }),
        ],
        vec![("its rounding is at most v of F̂²", ((computed - rr) * delta).within(v * (1.0 + limit)))],
        vec![("q is off by at most γ5 + v (1 + γ5) of F²", {
            ((computed - rr) * (1.0 + delta) - (1.0 - rr)).within(limit + v * (1.0 + limit))
        })],
    )
}

/// Step 2: the sum, in units of a F². What is subtracted has γ9 or a little more, and the last rounding is of the larger.
fn short_sum<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let v = r.get("v");
    let (b, q) = ((1.0 + v).power(9), (1.0 + v).power(3) * (1.0 + r.ratio(601.0, 100.0) * v));
    follows(
        vec![("v is in range", r.in_unit(v, 4096.0))],
        vec![],
        vec![("all three are at most 20 v", { (b - 1.0 + q - 1.0 + v * b.or_more(q)).at_most(20.0 * v) })],
    )
}

/// Step 2: what is added, in units of a F².
fn short_difference<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, delta] = r.each(["v", "δ"]);
    let [bb, computed_bb, of_b] = r.each(["b²", "fl(b²)", "off b²"]);
    let [aq, computed_aq, of_q] = r.each(["a q", "fl(a q)", "off a q"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    let larger = 1.0 + of_b.or_more(of_q);
    let computed = computed_bb - computed_aq;
    follows(
        vec![
            ("b² and a q are at most a F²", r.all(&[bb.at_most(one), aq.at_most(one)])),
            ("b² is off by that", (computed_bb - bb).within(of_b)),
            ("a q is off by that", (computed_aq - aq).within(of_q)),
            ("neither is computed negative", r.all(&[zero.at_most(computed_bb), zero.at_most(computed_aq)])),
            ("the difference has one rounding", delta.within(v)),
        ],
        vec![
            ("it is at most the larger", computed.within(larger)),
            ("so its rounding is v of that", (computed * delta).within(v * larger)),
        ],
        vec![("D is off by both and the rounding", {
            (computed * (1.0 + delta) - (bb - aq)).within(of_b + of_q + v * larger)
        })],
    )
}

/// Step 3: h is √κ.
fn short_said<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, e, h, g, far] = r.each(["v", "e", "√κ", "g", "F/r"]);
    let (zero, one) = (r.number(0.0), r.number(1.0));
    follows(
        vec![
            ("e is below √(2 v)", r.all(&[zero.at_most(e), e.square().below(2.0 * v)])),
            ("e is said as it is", (v * g * 20.0 * far).at_most(e * h)),
            ("v and √κ are positive", r.all(&[zero.below(v), zero.below(h)])),
            ("g is at least 1", one.at_most(g)),
            ("F/r is not negative", zero.at_most(far)),
        ],
        vec![
            ("20 v F/r is at most e √κ", (v * 20.0 * far).at_most(e * h)),
            ("and so its square", (v * 20.0 * far).square().at_most((e * h).square())),
        ],
        vec![("20 v F² is below κ r² / 10", (200.0 * v * far.square()).below(h.square()))],
    )
}

/// Step 4: K is κ r² a, E is 20 v a F².
fn short_sign<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, own, computed, k, off] = r.each(["v", "D", "D̂", "K", "E"]);
    let zero = r.number(0.0);
    follows(
        vec![
            ("v is in range", r.in_unit(v, 4096.0)),
            ("step 3 holds", (10.0 * off).below(k)),
            ("D̂ is above what is asked", (k * (1.0 - v).power(3)).below(computed)),
            ("D̂ is off by at most E", (computed - own).within(off)),
        ],
        vec![("E is at most D̂ / 9.9", (r.ratio(99.0, 10.0) * off).at_most(computed))],
        vec![
            ("D̂ is off by at most D̂ / 9.9", {
                (r.ratio(99.0, 10.0) * (computed - own)).within(computed)
            }),
            ("D is positive", zero.below(own)),
        ],
    )
}

/// Step 4: b, in units of F n; h is √g.
fn short_ahead<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, b, computed, h] = r.each(["v", "b", "b̂", "√g"]);
    let (zero, two) = (r.number(0.0), r.ratio(201.0, 100.0));
    follows(
        vec![
            ("v is in range", r.in_unit(v, 4096.0)),
            ("√g is positive, and g at most 2.01", r.all(&[zero.below(h), h.square().at_most(two)])),
            ("b² is above a q", r.number(1.0).below(b.square() * h.square())),
            ("b is off by at most 4.01 v F n", (computed - b).within(r.ratio(401.0, 100.0) * v)),
            ("b̂ is negative", computed.below(zero)),
        ],
        vec![],
        vec![("b is negative", b.below(zero))],
    )
}

/// Step 5: q is √(1 − 1/9.9), w is (1 − v)^(3/2).
fn short_roots<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, q, w] = r.each(["v", "√(1 − 1/9.9)", "√(1 − v)³"]);
    let (least, tenth) = (r.ratio(89.0, 10.0), r.ratio(99.0, 10.0));
    follows(
        vec![
            ("v is in range", r.in_unit(v, 4096.0)),
            ("one root is at least that", {
                r.all(&[r.not_negative([q]), least.at_most(tenth * q.square())])
            }),
            ("the other is at least that", {
                r.all(&[r.not_negative([w]), (1.0 - v).power(3).at_most(w.square())])
            }),
        ],
        vec![],
        vec![("the sum of the roots is at least 1.94 √K", {
            r.ratio(194.0, 100.0).at_most((1.0 + q) * w)
        })],
    )
}

/// Step 5: a difference of squares, by the sum.
fn short_apart<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [own, computed, sum, off] = r.each(["√D", "√D̂", "sum", "E"]);
    follows(
        vec![
            ("the roots are together at least that", sum.at_most(own + computed)),
            ("which is positive", r.number(0.0).below(sum)),
            ("D̂ is off by at most E", (computed.square() - own.square()).within(off)),
        ],
        vec![],
        vec![("√D̂ is off by at most E over that", ((computed - own) * sum).within(off))],
    )
}

/// Step 6: in units of √(a q), with h = √g and m = F/(√κ r).
fn short_total<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, h, m, b, computed_b] = r.each(["v", "√g", "m", "b", "b̂"]);
    let [s, root, computed_s] = r.each(["S", "√D̂", "ŝ"]);
    let [of_b, of_d] = [r.ratio(401.0, 100.0), 20.0 / r.ratio(194.0, 100.0)];
    let c = v * (of_b * h + r.ratio(104.0, 10.0) * h * m + r.ratio(11.0, 10.0));
    let one = r.number(1.0);
    follows(
        vec![
            ("v is in range", r.in_unit(v, 4096.0)),
            ("b is at most −√(a q), and S not negative", {
                r.all(&[b.at_most(-one), r.not_negative([s])])
            }),
            ("b is off by that of step 1", (computed_b - b).within(of_b * v * h)),
            ("√D̂ by that of step 5", (root - s).within(of_d * v * h * m)),
            ("and it is rounded once", (computed_s - root).within(v * root)),
        ],
        vec![
            ("the rounding is at most v S, and a little", {
                (computed_s - root).within(v * (s + of_d * v * h * m))
            }),
            ("S − b is at least 1, and S", r.all(&[one.at_most(s - b), s.at_most(s - b)])),
            ("with that of step 5 it is 10.4 and v S", {
                (computed_s - s).within(v * s + r.ratio(104.0, 10.0) * v * h * m)
            }),
        ],
        vec![("Σ is off by at most c of itself", {
            (computed_s - computed_b - (s - b)).within(c * (s - b))
        })],
    )
}

/// The variables of step 7.
struct Short<M: Machine> {
    v: Real<M>,
    /// Of Σ.
    c: Real<M>,
    /// Of q.
    q: Real<M>,
    e: Real<M>,
    assume: Vec<(&'static str, M::B)>,
}

fn short_terms<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Short<M> {
    let [v, h, m, e] = r.each(["v", "√g", "m", "e"]);
    let (zero, one, g) = (r.number(0.0), r.number(1.0), h.square());
    let c = v * (r.ratio(401.0, 100.0) * h + r.ratio(104.0, 10.0) * h * m + r.ratio(11.0, 10.0));
    let assume = vec![
        ("v is in range", r.in_unit(v, 4096.0)),
        ("√g and F/(√κ r) are in range", {
            r.all(&[one.at_most(h), g.at_most(r.ratio(201.0, 100.0)), zero.at_most(m)])
        }),
        ("e is said as it is", (v * g * (16.0 + 20.0 * m)).at_most(e)),
    ];
    Short { v, c, q: r.ratio(601.0, 100.0) * v * g, e, assume }
}

fn short_above<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Short { v, c, q, e, assume } = short_terms(r);
    let d = 1.0 - v;
    follows(
        assume,
        vec![],
        vec![("(1 + c)(1 + v) is at most (1 − 6.01 v g)(1 − v)²(1 + e (1 − v))", {
            ((1.0 + c) * (1.0 + v)).at_most((1.0 - q) * d.square() * (1.0 + e * d))
        })],
    )
}

fn short_below<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let Short { v, c, q, e, assume } = short_terms(r);
    let d = 1.0 - v;
    follows(
        assume,
        vec![],
        vec![("(1 + 6.01 v g)(1 + v)²(1 − e (1 − v)) is at most (1 − c)(1 − v)", {
            ((1.0 + q) * (1.0 + v).square() * (1.0 - e * d)).at_most((1.0 - c) * d)
        })],
    )
}

/// The upper end of the short way, if step 7 holds.
fn short_hi<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, q, e] = r.each(["v", "c", "ε", "e"]);
    let [t, computed_t, hi] = r.each(["t", "t̂", "hi"]);
    let (d, s) = (1.0 - v, 1.0 + v);
    follows(
        vec![
            ("v, c and e are in range", r.all(&[r.not_negative([v, c, e]), v.below(r.number(1.0))])),
            ("t is positive", r.not_negative([t])),
            ("t̂ has the errors of q and Σ, and two roundings", {
                (t * (1.0 - q) * d).at_most(computed_t * (1.0 + c) * s)
            }),
            ("the end has two more, of which e has one", (computed_t * (1.0 + e * d) * d).at_most(hi)),
            ("step 7 holds", ((1.0 + c) * s).at_most((1.0 - q) * d.square() * (1.0 + e * d))),
        ],
        vec![("t is at most the end, times (1 + c)(1 + v)", {
            (t * (1.0 + c) * s).at_most(computed_t * (1.0 + c) * s * (1.0 + e * d) * d)
        })],
        vec![("t is at most hi", t.at_most(hi))],
    )
}

/// The lower end.
fn short_lo<M: Machine>(r: &mut Reals<'_, M, impl Ask<M>>) -> Statement<M::B> {
    let [v, c, q, e] = r.each(["v", "c", "ε", "e"]);
    let [t, computed_t, lo] = r.each(["t", "t̂", "lo"]);
    let (d, s, one) = (1.0 - v, 1.0 + v, r.number(1.0));
    follows(
        vec![
            ("v, c and e are in range", {
                r.all(&[r.not_negative([v]), v.below(one), c.below(one), (e * d).at_most(one)])
            }),
            ("t is positive", r.not_negative([t])),
            ("t̂ has the errors of q and Σ, and two roundings", {
                (computed_t * (1.0 - c) * d).at_most(t * (1.0 + q) * s)
            }),
            ("the end has two more, of which e has one", lo.at_most(computed_t * (1.0 - e * d) * s)),
            ("step 7 holds", ((1.0 + q) * s.square() * (1.0 - e * d)).at_most((1.0 - c) * d)),
        ],
        vec![("the end is at most t, times (1 − c)(1 − v)", {
            (computed_t * (1.0 - c) * d * (1.0 - e * d) * s).at_most(t * (1.0 - c) * d)
        })],
        vec![("lo is at most t", lo.at_most(t))],
    )
}

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let v: &[(&str, u32)] = &[("v", SMALL)];
    let short: &[(&str, u32)] = &[("v", SMALLER)];
    let of_vectors: &[(&str, u32)] =
        &[("f x", ONE), ("f y", TWO), ("f z", HALF), ("d x", HALF), ("d y", ONE), ("d z", TWO)];
    let of_terms: &[(&str, u32)] =
        &[("v", SMALL), ("z", SIXTEENTH), ("y", HALF), ("β/σ", SIXTEENTH), ("ε", SIXTEENTH)];
    let of_ends: &[(&str, u32)] = &[
        ("v", SMALL),
        ("c", SIXTEENTH),
        ("ε", SIXTEENTH),
        ("e", HALF),
        ("q", ONE),
        ("Σ", ONE),
        ("t", ONE),
        ("σ", ONE),
        ("t̂", ONE),
        ("lo", QUARTER),
        ("hi", TWO),
    ];
    let of_short: &[(&str, u32)] = &[("v", SMALLER), ("√g", ONE), ("m", ZERO), ("e", TINY)];
    vec![
        lemma(
            "rounding.more",
            "If k roundings are within g of 1, one more is within (1 + g)(1 + v) − 1",
            &[("v", SMALL), ("g", SIXTEENTH), ("off", SMALL), ("δ", ZERO)],
            step!(one_more),
        ),
        lemma(
            "rounding.back",
            "If after k roundings the true result is within c − 1 of the computed one, after one more it is within c / (1 − v) − 1",
            &[("v", SMALL), ("c", TWO), ("true by computed", ONE), ("δ", ZERO)],
            step!(one_back),
        ),
        lemma(
            "rounding.root.1",
            "A component of the cross product is off by at most γ3 of its two terms",
            &[("fy dz", ONE), ("fz dy", TWO), ("g", ZERO), ("h", SMALL), ("γ3", SIXTEENTH)],
            step!(component),
        ),
        lemma(
            "rounding.root.2.lengths",
            "The vector of these terms has the squared length F² n² − (Σ x)² + 4 Σ x x",
            of_vectors,
            step!(lengths),
        ),
        lemma(
            "rounding.root.2.products",
            "3 Σ x x is at most (Σ x)²",
            &[("x", ONE), ("y", TWO), ("z", HALF)],
            step!(products),
        ),
        lemma(
            "rounding.root.2.cauchy",
            "A product of vectors is at most that of their lengths",
            of_vectors,
            step!(cauchy),
        ),
        lemma("rounding.root.2", "√(4/3) γ3 is at most 3.48 v", v, step!(cross)),
        lemma(
            "rounding.root.3",
            "Squares of vectors p apart differ by at most 2 p |ŵ| + p²",
            &[("|ŵ|", ONE), ("|ŵ − w|", SIXTEENTH), ("p", HALF), ("ŵ·(ŵ − w)", ZERO)],
            step!(squares),
        ),
        lemma(
            "rounding.root.4",
            "D is off by its roundings and by what |ŵ|² is",
            &[
                ("v", SMALL),
                ("g", SIXTEENTH),
                ("s", SIXTEENTH),
                ("δ", ZERO),
                ("A", ONE),
                ("a r²", ONE),
                ("W", HALF),
                ("|ŵ|²", HALF),
                ("|w|²", HALF),
            ],
            step!(discriminant),
        ),
        lemma(
            "rounding.root.5",
            "If squares are in order, but for roundings, so are lengths, but for half of them",
            &[("length", ONE), ("root of the computed", ONE), ("c", HALF)],
            step!(lengths_in_order),
        ),
        lemma("rounding.root.6.a", "6.96 (1 − v)⁻¹⁴ is at most 7 M", v, step!(slack_a)),
        lemma("rounding.root.6.b", "((1 − v)⁻³ − 1 + v)(1 − v)⁻⁵ is at most 5 M v", v, step!(slack_b)),
        lemma("rounding.root.6.c", "12.12 (1 − v)⁻¹⁰ is at most 14", v, step!(slack_c)),
        lemma(
            "rounding.root.6",
            "The computed slack's first term is no less than 2 p |ŵ|",
            &[("v", SMALL), ("h", ONE), ("F n", ONE), ("|ŵ|", ONE), ("√(G W)", TWO), ("M", TWO)],
            step!(first_term),
        ),
        lemma(
            "rounding.root.7.error",
            "q is off by F²'s five roundings and its own",
            &[("v", SMALL), ("g", SIXTEENTH), ("δ", ZERO), ("F̂²", TWO), ("F²", TWO), ("r²", ONE)],
            step!(eye_square),
        ),
        lemma("rounding.root.7", "The computed slack of q is no less", v, step!(eye_slack)),
        lemma(
            "rounding.root.8.error",
            "b is off by at most γ4 of its three terms",
            &[("x", ONE), ("y", TWO), ("z", HALF), ("γ4", SIXTEENTH), ("g", ZERO), ("h", ZERO), ("k", SMALL)],
            step!(along),
        ),
        lemma("rounding.root.8", "The computed slack of b is no less", v, step!(along_slack)),
        lemma(
            "rounding.root.9.sign",
            "Signs are certain beyond their slacks",
            &[("computed", ONE), ("true", ONE), ("slack", HALF)],
            step!(sign),
        ),
        lemma(
            "rounding.root.9.line",
            "If D < 0 the line misses the sphere",
            &[("a", ONE), ("b", ZERO), ("q", ONE), ("t", ONE)],
            step!(no_line),
        ),
        lemma(
            "rounding.root.9.behind",
            "If q > 0 and b > 0 the ray does",
            &[("a", ONE), ("b", ONE), ("q", ONE), ("t", ONE)],
            step!(behind),
        ),
        lemma(
            "rounding.root.9.outside",
            "If D >= 0, q > 0 and b < 0, the least root ahead is q / (S − b)",
            &[("a", ONE), ("b", MINUS_TWO), ("q", THREE), ("S", ONE), ("t", ONE), ("s", HALF)],
            step!(outside),
        ),
        lemma(
            "rounding.root.9.inside",
            "If D >= 0 and q < 0, the only root ahead is (S − b) / a, which is −q / (S + b)",
            &[("a", ONE), ("b", ZERO), ("q", MINUS_ONE), ("S", ONE), ("t", ONE), ("s", HALF)],
            step!(inside),
        ),
        lemma(
            "rounding.root.10.range",
            "z is below 0.3 if x is below 1/2",
            &[("x", SEVEN_SIXTEENTHS), ("z", QUARTER)],
            step!(half_way),
        ),
        lemma(
            "rounding.root.10",
            "√D̂ is off by at most z of itself, either way",
            &[("√D", ONE), ("√D̂", ONE), ("z", HALF)],
            step!(roots),
        ),
        lemma(
            "rounding.root.11",
            "The sum is off by at most β + (z + v) ŝ / (1 − v)",
            &[
                ("v", SMALL),
                ("z", SIXTEENTH),
                ("β", SIXTEENTH),
                ("b", MINUS_ONE),
                ("b̂", MINUS_ONE),
                ("S", ONE),
                ("√D̂", ONE),
                ("ŝ", ONE),
            ],
            step!(sums),
        ),
        lemma("rounding.root.12", "M (1 − v)¹¹ is at least 1 + 27 v", v, step!(eleven)),
        lemma("rounding.root.13.share", "c is at most 10/17 of e₀, less 33/17 v", of_terms, step!(share)),
        lemma(
            "rounding.root.13.upper",
            "(1 + ε)(1 + v) <= (1 − c)(1 + e)(1 − v)³",
            &[("v", SMALL), ("c (1 − v)", ZERO), ("e₀ − ε", SIXTEENTH), ("ε", SIXTEENTH)],
            step!(quotient_above),
        ),
        lemma(
            "rounding.root.13.lower",
            "(1 − e)(1 + c)(1 + v)³ <= (1 − ε)(1 − v)",
            of_terms,
            step!(quotient_below),
        ),
        lemma(
            "rounding.root.13.hi",
            "So the true root is not above the upper end of a quotient",
            of_ends,
            step!(quotient_hi),
        ),
        lemma("rounding.root.13.lo", "Nor below the lower end", of_ends, step!(quotient_lo)),
        lemma("rounding.root.14.upper", "(1 + c)(1 + v)² <= (1 + e)(1 − v)⁴", of_terms, step!(sum_above)),
        lemma("rounding.root.14.lower", "(1 − e)(1 + v)⁴ <= (1 − c)(1 − v)²", of_terms, step!(sum_below)),
        lemma(
            "rounding.root.14.hi",
            "So it is not above the upper end of a sum over a",
            of_ends,
            step!(sum_hi),
        ),
        lemma("rounding.root.14.lo", "Nor below the lower end", of_ends, step!(sum_lo)),
        lemma(
            "rounding.short.1",
            "q's and b's roundings are at most 6.01 v and 4.01 v",
            short,
            step!(short_parts),
        ),
        lemma(
            "rounding.short.1.q",
            "q is off by at most γ5 + v (1 + γ5) of F²",
            &[("v", SMALLER), ("γ5", SIXTEENTH), ("g", ZERO), ("δ", ZERO), ("r²", HALF)],
            step!(short_eye),
        ),
        lemma("rounding.short.2", "D's roundings are at most 20 v", short, step!(short_sum)),
        lemma(
            "rounding.short.2.difference",
            "D is off by what b² and a q are, and by v of the larger",
            &[
                ("v", SMALLER),
                ("δ", ZERO),
                ("b²", ONE),
                ("fl(b²)", ONE),
                ("off b²", SMALL),
                ("a q", HALF),
                ("fl(a q)", HALF),
                ("off a q", SMALL),
            ],
            step!(short_difference),
        ),
        lemma(
            "rounding.short.3",
            "Where the short way is gone, 20 v F² is below κ r² / 10",
            &[("v", SMALLER), ("e", TINY), ("√κ", ONE), ("g", ONE), ("F/r", ONE)],
            step!(short_said),
        ),
        lemma(
            "rounding.short.4",
            "D is off by at most D̂ / 9.9, and positive",
            &[("v", SMALLER), ("D", TWO), ("D̂", TWO), ("K", ONE), ("E", SIXTEENTH)],
            step!(short_sign),
        ),
        lemma(
            "rounding.short.4.b",
            "b's sign is certain",
            &[("v", SMALLER), ("b", MINUS_TWO), ("b̂", MINUS_TWO), ("√g", ONE)],
            step!(short_ahead),
        ),
        lemma(
            "rounding.short.5",
            "√D and √D̂ are together at least 1.94 √κ √a r",
            &[("v", SMALLER), ("√(1 − 1/9.9)", ONE), ("√(1 − v)³", ONE)],
            step!(short_roots),
        ),
        lemma(
            "rounding.short.5.apart",
            "So √D̂ is off by at most 20 v a F² over that",
            &[("√D", ONE), ("√D̂", ONE), ("sum", ONE), ("E", HALF)],
            step!(short_apart),
        ),
        lemma(
            "rounding.short.6",
            "Σ is off by at most v (4.01 √g + 10.4 √g F/(√κ r) + 1.1) of itself",
            &[
                ("v", SMALLER),
                ("√g", ONE),
                ("m", ONE),
                ("b", MINUS_ONE),
                ("b̂", MINUS_ONE),
                ("S", ONE),
                ("√D̂", ONE),
                ("ŝ", ONE),
            ],
            step!(short_total),
        ),
        lemma(
            "rounding.short.7.upper",
            "The upper end of the short way is not below the root",
            of_short,
            step!(short_above),
        ),
        lemma(
            "rounding.short.7.lower",
            "The lower end of the short way is not above the root",
            of_short,
            step!(short_below),
        ),
        lemma(
            "rounding.short.7.hi",
            "As t has the errors of q and Σ, and four roundings",
            of_ends,
            step!(short_hi),
        ),
        lemma("rounding.short.7.lo", "And so has the lower end", of_ends, step!(short_lo)),
    ]
}
