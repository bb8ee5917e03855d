//! One short program per way of using the libraries; see the files beside this folder.
