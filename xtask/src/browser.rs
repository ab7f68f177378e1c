//! Tests of the page in a browser without a window.
