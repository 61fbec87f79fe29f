//! Is the picture right? Against closed forms, and method against method.

mod furnace;
mod references;
