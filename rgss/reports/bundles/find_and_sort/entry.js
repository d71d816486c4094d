// What the report uses of both packages; `npm ci && npm run build` in the folder above makes find_and_sort.min.js of it.
export { default as MiniSearch } from "minisearch";
export { createNewSortInstance } from "fast-sort";
