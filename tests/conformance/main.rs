//! Is the picture right? Against closed forms, and method against method.

mod agreement;
mod edges;
mod furnace;
mod references;
mod strangers;
