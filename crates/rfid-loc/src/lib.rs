//! Localises radio tags with a grid Bayes filter and derives the transform between two robots that saw the same tags.
