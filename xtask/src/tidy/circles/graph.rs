//! The files of a crate and which of them import which.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::file::{File, Import};

/// The place of a module: the names from the root of the crate.
type Module = Vec<String>;

/// The files of a crate by the module that each of them is.
pub(super) struct Crate<'a> {
    files: BTreeMap<Module, (&'a str, File)>,
}

/// What a path leads to.
enum Target {
    Module(Module),
    /// An item of the file of this module.
    Item(Module),
}

/// Exports through which a name is followed; only names that lead in circles take more.
const MAX_EXPORTS: usize = 16;

impl<'a> Crate<'a> {
    pub(super) fn read(sources: &BTreeMap<&'a str, &'a str>) -> Self {
        let files = sources
            .iter()
            .filter_map(|(&path, &text)| Some((module_of(path)?, (path, File::read(text)))));
        Self { files: files.collect() }
    }

    /// The shortest circle through each file that is in one and not yet named, first name first.
    pub(super) fn circles(&self) -> Vec<Vec<&'a str>> {
        let imports: BTreeMap<&'a str, BTreeSet<&'a str>> = self
            .files
            .iter()
            .map(|(module, (path, file))| (*path, self.imported_by(module, path, file)))
            .collect();
        let mut named = BTreeSet::new();
        let mut circles: Vec<Vec<&'a str>> = Vec::new();
        for &start in imports.keys() {
            let Some(mut circle) = shortest_circle(start, &imports) else { continue };
            if named.contains(start) {
                continue;
            }
            named.extend(circle.iter().copied());
            let first = (0..circle.len()).min_by_key(|&at| circle[at]).unwrap_or(0);
            circle.rotate_left(first);
            circles.push(circle);
        }
        circles.sort();
        circles
    }

    /// The other files that a file imports something from.
    fn imported_by(&self, module: &Module, path: &str, file: &File) -> BTreeSet<&'a str> {
        let is_used = |import: &&Import| {
            !import.is_public || import.name == "*" || file.words.contains(&import.name)
        };
        let imports = file.imports.iter().filter(is_used);
        let targets = imports
            .filter(|import| !(import.is_public && import.name == "*"))
            .map(|import| &import.path)
            .chain(&file.paths)
            .filter_map(|path| self.resolve(module, path, MAX_EXPORTS));
        let globs = file.imports.iter().filter(|import| import.name == "*" && !import.is_public);
        let from_globs =
            globs.filter_map(|import| match self.resolve(module, &import.path, MAX_EXPORTS)? {
                Target::Module(of) => Some(of),
                Target::Item(_) => None,
            });
        let by_glob = from_globs.flat_map(|of| {
            let words = file.words.iter();
            words.filter_map(move |word| self.item(&of, word, MAX_EXPORTS))
        });
        let modules = targets.chain(by_glob).filter_map(|target| match target {
            Target::Item(of) => Some(of),
            Target::Module(_) => None,
        });
        let files = modules.filter_map(|of| Some(self.files.get(&of)?.0));
        files.filter(|other| *other != path).collect()
    }

    /// What a path written in a module leads to; `None` for other crates.
    fn resolve(&self, module: &Module, path: &[String], exports: usize) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.descend(Vec::new(), rest, exports),
            "self" => self.descend(module.clone(), rest, exports),
            "super" => {
                let (_, parent) = module.split_last()?;
                let above = rest.iter().take_while(|word| *word == "super").count();
                let depth = parent.len().checked_sub(above)?;
                self.descend(parent[..depth].to_vec(), &rest[above..], exports)
            }
            name => match self.item(module, name, exports)? {
                Target::Module(of) => self.descend(of, rest, exports),
                // An item of this file: its variants and functions are here too.
                item => Some(item),
            },
        }
    }

    /// Follows the names of a path from a module on, to the first that is an item.
    fn descend(&self, from: Module, rest: &[String], exports: usize) -> Option<Target> {
        let mut module = from;
        for name in rest {
            match self.item(&module, name, exports) {
                Some(Target::Module(of)) => module = of,
                Some(item) => return Some(item),
                // What a macro defines.
                None => return Some(Target::Item(module)),
            }
        }
        Some(Target::Module(module))
    }

    /// What a name means in a module.
    fn item(&self, module: &Module, name: &str, exports: usize) -> Option<Target> {
        let (_, file) = self.files.get(module)?;
        if file.items.contains(name) {
            return Some(Target::Item(module.clone()));
        }
        let exports = exports.checked_sub(1)?;
        // `csv` may be a module and a function of it: the function is what others can use.
        let imports = file.imports.iter();
        let named = imports.filter(|import| import.name == name && import.path != [name]);
        let by_name = named.filter_map(|import| self.resolve(module, &import.path, exports)).next();
        let is_module = file.modules.contains(name);
        let child = || [&module[..], &[name.to_owned()]].concat();
        if let Some(target) = by_name.filter(|target| !is_module || is_item(target)) {
            return Some(target);
        }
        if is_module {
            return Some(Target::Module(child()));
        }
        let globs = file.imports.iter().filter(|import| import.name == "*");
        globs
            .filter_map(|import| match self.resolve(module, &import.path, exports)? {
                Target::Module(of) if of != *module => self.item(&of, name, exports),
                _ => None,
            })
            .next()
    }
}

fn is_item(target: &Target) -> bool {
    matches!(target, Target::Item(_))
}

/// The module that a file is: `src/a/b.rs` is `a::b`.
fn module_of(path: &str) -> Option<Module> {
    let (_, inside) = path.rsplit_once("src/")?;
    let inside = inside.strip_suffix(".rs")?;
    if matches!(inside, "lib" | "main") {
        return Some(Vec::new());
    }
    let inside = inside.strip_suffix("/mod").unwrap_or(inside);
    Some(inside.split('/').map(str::to_owned).collect())
}

/// The shortest way from a file back to itself.
fn shortest_circle<'a>(
    start: &'a str,
    imports: &BTreeMap<&'a str, BTreeSet<&'a str>>,
) -> Option<Vec<&'a str>> {
    let mut queue = VecDeque::from([vec![start]]);
    let mut seen = BTreeSet::new();
    while let Some(way) = queue.pop_front() {
        for &next in imports.get(way.last()?)? {
            if next == start {
                return Some(way);
            }
            if seen.insert(next) {
                queue.push_back([&way[..], &[next]].concat());
            }
        }
    }
    None
}
