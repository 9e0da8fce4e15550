/** Paths are from the project's root: `npm run lint` starts there. */
import js from '@eslint/js';
import globals from 'globals';

const rules = { 'no-var': 'error', 'prefer-const': 'error', eqeqeq: 'error', 'no-shadow': 'error', 'max-lines': ['error', 400],
  'max-len': ['error', { code: 180 }] };

export default [
  { ignores: ['**/node_modules/'] },
  js.configs.recommended,
  { rules },
  { files: ['experiments/explorer/page/*.js'], languageOptions: { globals: globals.browser } },
  { files: ['experiments/explorer/page/worker.js'], languageOptions: { globals: globals.worker } },
  { files: ['experiments/adapters/npm/*.mjs'], languageOptions: { globals: globals.node } },
  { files: ['tests/explorer/*'], languageOptions: { globals: { ...globals.node, ...globals.browser } } },
];
