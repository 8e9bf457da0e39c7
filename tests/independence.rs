//! Are the two worlds apart? `reference` and `optimized` must not reach each other, nor share a crate that
//! computes: only the contract's data, the derivation of error messages, and who does which part of the work.

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, PackageId};
use std::collections::BTreeSet;

/// What both may use, and why it computes nothing.
const SHARED: [(&str, &str); 6] = [
    ("contract", "data"),
    ("thiserror", "messages of errors"),
    ("thiserror-impl", "runs in the compiler, for thiserror"),
    ("proc-macro2", "runs in the compiler"),
    ("quote", "runs in the compiler"),
    ("syn", "runs in the compiler"),
];
/// What both may use to share work among threads: it decides when something is computed, never what.
const SCHEDULING: [&str; 6] =
    ["rayon", "rayon-core", "crossbeam-deque", "crossbeam-epoch", "crossbeam-utils", "either"];
/// A table of characters that the compiler-side crates use.
const UNICODE: &str = "unicode-ident";

#[test]
fn reference_and_optimized_share_only_data() {
    let metadata = MetadataCommand::new().exec().expect("cargo metadata runs in this workspace");
    let reference = reaches(&metadata, "reference");
    let optimized = reaches(&metadata, "optimized");
    assert!(!reference.contains("optimized"), "reference reaches optimized");
    assert!(!optimized.contains("reference"), "optimized reaches reference");
    for world in [&reference, &optimized] {
        assert!(world.contains("contract"), "the contract is not reached: did the walk work? {world:?}");
        assert!(!world.contains("verify"), "an arrow runs backwards, to verify");
    }
    let allowed: BTreeSet<&str> =
        SHARED.iter().map(|(name, _)| *name).chain([UNICODE]).chain(SCHEDULING).collect();
    let shared: BTreeSet<&str> = reference.intersection(&optimized).map(String::as_str).collect();
    let excess: Vec<_> = shared.difference(&allowed).collect();
    assert!(excess.is_empty(), "reference and optimized both use {excess:?}");
    let needless: Vec<_> = allowed.difference(&shared).collect();
    assert!(needless.is_empty(), "allowed and no longer shared: {needless:?}");
}

#[test]
fn the_contract_depends_on_error_messages_alone() {
    let metadata = MetadataCommand::new().exec().expect("cargo metadata runs in this workspace");
    let allowed = SHARED.iter().map(|(name, _)| (*name).to_owned()).chain([UNICODE.to_owned()]).collect();
    assert_eq!(reaches(&metadata, "contract"), allowed);
}

/// The names of all packages that a package of the workspace reaches, itself included; not what only its tests use.
fn reaches(metadata: &Metadata, name: &str) -> BTreeSet<String> {
    let nodes = &metadata.resolve.as_ref().expect("resolved").nodes;
    let root = metadata.workspace_packages().into_iter().find(|p| p.name.as_str() == name);
    let mut open: Vec<&PackageId> = vec![&root.unwrap_or_else(|| panic!("no package {name}")).id];
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let node = nodes.iter().find(|node| node.id == *id).expect("every package is resolved");
        let shipped = node
            .deps
            .iter()
            .filter(|dep| dep.dep_kinds.iter().any(|k| k.kind != DependencyKind::Development));
        open.extend(shipped.map(|dep| &dep.pkg));
    }
    seen.into_iter().map(|id| metadata[id].name.to_string()).collect()
}
