;;; gcheck.el --- Check CNC part programs (G-code) with gcheck  -*- lexical-binding: t; -*-

;;; Commentary:

;; A major mode that knows the files of part programs, and the server for eglot.

;;; Code:

(defgroup gcheck nil
  "CNC part programs."
  :group 'languages)

(defcustom gcheck-command (list (or (getenv "GCHECK_PATH") "gcheck") "lsp")
  "The program that checks, with its arguments."
  :type '(repeat string))

(defvar gcode-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?\( "<" table)
    (modify-syntax-entry ?\) ">" table)
    (modify-syntax-entry ?# "_" table)
    table)
  "A comment stands in parentheses.")

(defconst gcode-font-lock-keywords
  '(("^\\s-*[O:]\\s-*[0-9]+" . font-lock-function-name-face)
    ("\\_<N[0-9]+" . font-lock-constant-face)
    ("[GM][0-9]+\\(\\.[0-9]+\\)?" . font-lock-keyword-face)
    ("#+[0-9]+\\|#<[^>]*>" . font-lock-variable-name-face)
    ("\\_<\\(IF\\|THEN\\|GOTO\\|WHILE\\|DO[0-9]?\\|END[0-9]?\\|SUB\\|ENDSUB\\|CALL\\|RETURN\\)" . font-lock-builtin-face))
  "What the lexer can say.")

;;;###autoload
(define-derived-mode gcode-mode prog-mode "G-code"
  "Major mode for CNC part programs."
  (setq-local comment-start "(" comment-end ")")
  (setq-local font-lock-defaults '(gcode-font-lock-keywords nil t)))

;;;###autoload
(add-to-list 'auto-mode-alist
             '("\\.\\(nc\\|ngc\\|cnc\\|tap\\|eia\\|ncf\\|gcode\\|iso\\|din\\|prg\\|mpf\\|spf\\|min\\)\\'\\|/O[0-9]\\{4,5\\}\\'" . gcode-mode))

;;;###autoload
(define-derived-mode gcheck-toml-mode conf-toml-mode "gcheck.toml"
  "Major mode for the configuration of gcheck, a file in TOML.")

;;;###autoload
(add-to-list 'auto-mode-alist '("/\\.?gcheck\\.toml\\'" . gcheck-toml-mode))

(with-eval-after-load 'eglot
  ;; Files in TOML that are not of gcheck keep the server that they have.
  (add-to-list 'eglot-server-programs
               (cons '(gcode-mode (gcheck-toml-mode :language-id "toml")) gcheck-command)))

(provide 'gcheck)
;;; gcheck.el ends here
