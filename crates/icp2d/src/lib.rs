//! Rigid 2D alignment of wall points by ICP that pairs only walls seen from the same side.
