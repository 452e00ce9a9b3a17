//! The proof: experiments and checks of the workspace.

fn main() {}
