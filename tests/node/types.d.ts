// The two libraries of the page have no types in Debian; what we call of them is small and tested in
// a browser.
declare const Dygraph: any;
declare const THREE: any;
