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

(defface gcode-rapid
  '((t :inherit font-lock-warning-face))
  "A code that moves at rapid.")

(defface gcode-feed
  '((t :inherit font-lock-keyword-face))
  "A code that cuts in a straight line.")

(defface gcode-arc
  '((t :inherit font-lock-type-face))
  "A code that cuts along a curve.")

(defface gcode-code
  '((t :inherit font-lock-builtin-face))
  "Any other code.")

(defface gcode-tool
  '((t :inherit font-lock-string-face))
  "A tool word, or the speed of the spindle.")

(defface gcode-label
  '((t :inherit font-lock-constant-face))
  "A sequence number.")

(defface gcode-program
  '((t :inherit font-lock-function-name-face))
  "A program number, and the tape marks.")

(defface gcode-variable
  '((t :inherit font-lock-variable-name-face))
  "A variable.")

(defface gcode-flow
  '((t :inherit font-lock-preprocessor-face))
  "A word that decides where the program goes on.")

(defconst gcode-font-lock-keywords
  (let ((code (lambda (number) (concat "\\(G[ \t]*0*" number "\\)\\(?:[^0-9.]\\|$\\)"))))
    `(("^\\s-*\\([O:]\\s-*[0-9]+\\|%.*\\)" 1 'gcode-program)
      ("#+[0-9]+\\|#\\s-*<[^>]*>" 0 'gcode-variable)
      ("\\_<\\(IF\\|THEN\\|ELSE\\|GOTO\\|WHILE\\|DO\\|END\\|SUB\\|ENDSUB\\|CALL\\|RETURN\\|REPEAT\\)[0-9]*\\_>" 0 'gcode-flow)
      ("\\_<N\\s-*[0-9]+" 0 'gcode-label)
      (,(funcall code "0") 1 'gcode-rapid)
      (,(funcall code "1") 1 'gcode-feed)
      (,(funcall code "[23]") 1 'gcode-arc)
      ("[GM][ \t]*[0-9]+\\(\\.[0-9]+\\)?" 0 'gcode-code)
      ("[TS][ \t]*[0-9]+" 0 'gcode-tool)))
  "What the lexer can say, by the role of a word.")

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
