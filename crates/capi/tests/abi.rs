//! The ABI only grows: functions, values and places of fields, as a C compiler sees them, are those of a checked-in list.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn compiler() -> String {
    std::env::var("CC").unwrap_or_else(|_| "cc".to_owned())
}

/// The header without comments and preprocessor, each declaration in one line.
fn declarations() -> Vec<String> {
    let text = std::fs::read_to_string(root().join("include/atrous.h")).expect("include/atrous.h");
    let (_, behind_head) = text.split_once("*/").expect("a comment at the head");
    let code = behind_head
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with("extern"))
        .filter_map(|line| line.split("//").next());
    let mut whole = String::new();
    let (mut all, mut depth) = (Vec::new(), 0);
    for word in code.flat_map(str::split_whitespace) {
        depth += word.matches('{').count();
        depth -= word.matches('}').count().min(depth);
        whole = format!("{whole} {word}");
        if depth == 0 && word.ends_with(';') {
            all.push(std::mem::take(&mut whole));
        }
    }
    all
}

/// Prints a line for each field, with its place.
fn printer(declarations: &[String]) -> String {
    let mut body = String::new();
    for declaration in declarations {
        let Some((head, fields)) = declaration.split_once('{').filter(|(head, _)| head.contains("typedef struct")) else {
            continue;
        };
        let name = head.split_whitespace().nth(2).expect("a name");
        let fields = fields.split_once('}').expect("an end").0;
        let mut last = "";
        for field in fields.split(';').map(str::trim).filter(|field| !field.is_empty()) {
            last = field.rsplit([' ', '*']).next().and_then(|f| f.split('[').next()).expect("a field");
            body += &format!("    PLACE({name}, {last});\n");
        }
        body += &format!("    if (END({name}, {last}) != sizeof({name})) printf(\"PADDING at the end of {name}\\n\");\n");
    }
    format!(
        "#include <stddef.h>\n#include <stdio.h>\n#include \"atrous.h\"\n\
         #define END(s, f) (offsetof(s, f) + sizeof(((s *)0)->f))\n\
         #define PLACE(s, f) printf(\"%s.%s at %zu of %zu\\n\", #s, #f, offsetof(s, f), sizeof(((s *)0)->f))\n\
         int main(void) {{\n{body}    return 0;\n}}\n"
    )
}

fn abi() -> BTreeSet<String> {
    let declarations = declarations();
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let (source, program) = (folder.join("layout.c"), folder.join("layout"));
    std::fs::write(&source, printer(&declarations)).expect("a file");
    let built = Command::new(compiler())
        .args(["-std=c99", "-Wall", "-Werror", "-I"])
        .arg(root().join("include"))
        .arg(&source)
        .arg("-o")
        .arg(&program)
        .output();
    let built = built.expect("a C compiler: scripts/setup.sh --test installs one");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let printed = Command::new(&program).output().expect("the program").stdout;
    let places = String::from_utf8(printed).expect("UTF-8");
    let functions = declarations.iter().filter(|d| d.contains("atrous_") && d.contains('(')).map(|d| d.trim().to_owned());
    let values = declarations.iter().filter(|d| d.contains("enum ")).flat_map(|d| {
        let inside = d.split_once('{').and_then(|(_, rest)| rest.split_once('}')).map_or("", |(inside, _)| inside);
        inside.split(',').map(|value| value.trim().to_owned()).filter(|value| value.contains(" = ")).collect::<Vec<_>>()
    });
    functions.chain(values).chain(places.lines().map(str::to_owned)).collect()
}

#[test]
fn the_abi_only_grows() {
    let path = root().join("tests/abi.txt");
    let now = abi();
    let padding: Vec<_> = now.iter().filter(|line| line.starts_with("PADDING")).collect();
    assert!(
        padding.is_empty(),
        "{padding:?}: a field that fills it later would read garbage of older hosts; add one that fills it now"
    );
    let listed: BTreeSet<_> = std::fs::read_to_string(&path).unwrap_or_default().lines().map(str::to_owned).collect();
    let lost: Vec<_> = listed.difference(&now).collect();
    assert!(
        lost.is_empty(),
        "older hosts count on these, which are gone or moved; put new fields last in their struct or table, \
         or raise the major version and delete tests/abi.txt:\n{lost:#?}"
    );
    if std::env::var("ATROUS_UPDATE_ABI").is_ok_and(|v| v == "1") {
        let lines: Vec<_> = now.iter().map(|line| format!("{line}\n")).collect();
        std::fs::write(&path, lines.concat()).expect("tests/abi.txt");
        return;
    }
    let new: Vec<_> = now.difference(&listed).collect();
    assert!(
        new.is_empty(),
        "new in the ABI: ATROUS_UPDATE_ABI=1 cargo test -p atrous-capi --test abi adds them for good:\n{new:#?}"
    );
}
