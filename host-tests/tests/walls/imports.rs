//! Which file of a crate takes names from which: its module tree, read by `syn`, and the paths in its code.
//!
//! A `pub use` is a signpost, not a use: who follows it takes the name from the file behind it. Tests may take what they
//! like, and so they are left out. Names that a macro makes are not seen.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use syn::visit::Visit;
use syn::{Attribute, Item, ItemMod, ItemUse, UseTree, Visibility};

/// That `from` takes `name` from `to`; files from the crate's root file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Import {
    /// The file that takes.
    pub from: PathBuf,
    /// The file that has.
    pub to: PathBuf,
    /// The path as it is written.
    pub name: String,
}

/// A module, in a file of its own or within another's.
#[derive(Debug, Default)]
struct Module {
    file: PathBuf,
    parent: usize,
    children: BTreeMap<String, usize>,
    /// What `use` lines bring in, by the name that it has here.
    brought: BTreeMap<String, Vec<String>>,
    /// Every path that the code takes, as written.
    taken: Vec<Vec<String>>,
}

/// The modules of a crate; the first is its root.
#[derive(Debug, Default)]
pub struct Crate {
    modules: Vec<Module>,
}

impl Crate {
    /// The crate below a root file, such as `model-core/src/lib.rs`; `read` gives the text of a file, if there is one.
    pub fn of(root: &Path, read: &impl Fn(&Path) -> Option<String>) -> Self {
        let mut tree = Self::default();
        let folder = root.parent().expect("a root file is in a folder").to_owned();
        let text = read(root).unwrap_or_else(|| panic!("no file {}", root.display()));
        tree.add(&items(root, &text), root, &folder, 0, read);
        tree
    }

    fn add(
        &mut self,
        items: &[Item],
        file: &Path,
        folder: &Path,
        parent: usize,
        read: &impl Fn(&Path) -> Option<String>,
    ) -> usize {
        let here = self.modules.len();
        self.modules.push(Module { file: file.to_owned(), parent, ..Module::default() });
        let mut seen = Seen::default();
        for item in items {
            match item {
                Item::Mod(inner) if !for_tests(&inner.attrs) => {
                    if let Some(child) = self.inner(inner, file, folder, here, read) {
                        self.modules[here].children.insert(inner.ident.to_string(), child);
                    }
                }
                item => seen.visit_item(item),
            }
        }
        self.modules[here].brought = seen.brought;
        self.modules[here].taken = seen.taken;
        here
    }

    /// A module within a module: its body, or the file that has it.
    fn inner(
        &mut self,
        inner: &ItemMod,
        file: &Path,
        folder: &Path,
        here: usize,
        read: &impl Fn(&Path) -> Option<String>,
    ) -> Option<usize> {
        let below = folder.join(inner.ident.to_string());
        if let Some((_, items)) = &inner.content {
            return Some(self.add(items, file, &below, here, read));
        }
        let found = [folder.join(format!("{}.rs", inner.ident)), below.join("mod.rs")]
            .into_iter()
            .find_map(|path| read(&path).map(|text| (path, text)));
        let (path, text) = found?;
        Some(self.add(&items(&path, &text), &path, &below, here, read))
    }

    /// All that files take from other files.
    pub fn imports(&self) -> Vec<Import> {
        let mut found = Vec::new();
        for (at, module) in self.modules.iter().enumerate() {
            for path in &module.taken {
                if let Some(home) = self.home(at, path, 0).filter(|home| self.modules[*home].file != module.file) {
                    let to = self.modules[home].file.clone();
                    found.push(Import { from: module.file.clone(), to, name: path.join("::") });
                }
            }
        }
        found.sort();
        found.dedup();
        found
    }

    /// The module that defines what a path in module `at` names; none for a module itself, and for another crate's.
    fn home(&self, at: usize, path: &[String], depth: usize) -> Option<usize> {
        if depth > 16 {
            return None; // two signposts that point at each other
        }
        let (mut now, mut rest) = (at, path);
        match rest.first()?.as_str() {
            "crate" => (now, rest) = (0, &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {}
            first => {
                let module = &self.modules[at];
                if !module.children.contains_key(first) && !module.brought.contains_key(first) {
                    return None; // of this file, or of another crate
                }
            }
        }
        while let Some((name, after)) = rest.split_first() {
            let module = &self.modules[now];
            if name == "super" {
                now = module.parent;
            } else if let Some(child) = module.children.get(name) {
                now = *child;
            } else if let Some(target) = module.brought.get(name).filter(|target| target.as_slice() != path) {
                let whole: Vec<String> = target.iter().chain(after).cloned().collect();
                return self.home(now, &whole, depth + 1);
            } else {
                return Some(now);
            }
            rest = after;
        }
        None
    }
}

/// What a walk over the code of one module has seen.
#[derive(Default)]
struct Seen {
    brought: BTreeMap<String, Vec<String>>,
    taken: Vec<Vec<String>>,
}

impl Seen {
    fn brings(&mut self, tree: &UseTree, above: &[String], signpost: bool) {
        let below = |name: &syn::Ident| [above, &[name.to_string()]].concat();
        match tree {
            UseTree::Path(path) => self.brings(&path.tree, &below(&path.ident), signpost),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.brings(tree, above, signpost)),
            UseTree::Glob(_) => self.taken.push([above, &["*".to_owned()]].concat()),
            UseTree::Name(name) if name.ident == "self" => self.bring(above.last(), above.to_vec(), signpost),
            UseTree::Name(name) => self.bring(Some(&name.ident.to_string()), below(&name.ident), signpost),
            UseTree::Rename(name) => self.bring(Some(&name.rename.to_string()), below(&name.ident), signpost),
        }
    }

    fn bring(&mut self, name: Option<&String>, path: Vec<String>, signpost: bool) {
        if !signpost {
            self.taken.push(path.clone());
        }
        self.brought.extend(name.map(|name| (name.clone(), path)));
    }
}

impl Visit<'_> for Seen {
    fn visit_item_use(&mut self, item: &ItemUse) {
        if !for_tests(&item.attrs) {
            self.brings(&item.tree, &[], !matches!(item.vis, Visibility::Inherited));
        }
    }

    fn visit_item_mod(&mut self, _: &ItemMod) {} // for tests: `add` has taken the others

    fn visit_item_fn(&mut self, item: &syn::ItemFn) {
        if !for_tests(&item.attrs) {
            syn::visit::visit_item_fn(self, item);
        }
    }

    fn visit_path(&mut self, path: &syn::Path) {
        self.taken.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        syn::visit::visit_path(self, path);
    }

    /// Within a macro's call there are only words: those joined by `::` are paths.
    fn visit_macro(&mut self, call: &syn::Macro) {
        let words = call.tokens.to_string().replace(" :: ", "::");
        let paths = words.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
        self.taken
            .extend(paths.filter(|path| path.contains("::")).map(|path| path.split("::").map(str::to_owned).collect()));
        syn::visit::visit_macro(self, call);
    }
}

fn items(path: &Path, text: &str) -> Vec<Item> {
    syn::parse_file(text).unwrap_or_else(|why| panic!("{}: {why}", path.display())).items
}

fn for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg") && attribute.parse_args::<syn::Ident>().is_ok_and(|what| what == "test")
    })
}
